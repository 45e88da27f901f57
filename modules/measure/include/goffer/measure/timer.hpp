// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

/// Times work, and picks what to say of many times. Work of one thread is timed by that thread's own clock,
/// which stands still while another process has the processor; work of several by the wall clock.

namespace goffer::measure {

/// In the place of a number of threads: the wall's clock, whoever does the work.
inline constexpr int wall_clock = 0;

/// Nanoseconds since some time in the past, by the clock for work of `threads` threads: with one, that of
/// the calling thread (of the wall, where a system has no other). Does not allocate. Thread-safe.
[[nodiscard]] double now(int threads) noexcept;

/// The nanoseconds that `work`, done by `threads` threads, takes; with one, by the calling thread.
template <class Work>
[[nodiscard]] double nanoseconds_of(int threads, Work&& work) {
    const double start = now(threads);
    std::forward<Work>(work)();
    return now(threads) - start;
}

/// The smallest value that at least `share` (0 to 1) of `values` do not exceed; 0 where there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// The quantile of one half.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace goffer::measure
