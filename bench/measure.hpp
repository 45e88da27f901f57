// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>

/// How a case is timed: in samples, each of them with a sample of the floor right after it. What slows the
/// machine down for a while slows both, and medians leave out what hits one sample. Work of one thread is
/// timed by that thread's own clock, which stands still while another process has the processor; work of
/// several by the wall clock.

namespace goffer::bench {

/// Calls that are timed `batch` at a time: so many that a sample is long beside a look at the clock.
struct Task {
    std::size_t batch = 1;
    int threads = 1;
    std::function<void()> prepare = {};           // before every sample, not timed; may be empty
    std::function<void(std::size_t)> work = {};   // does it so many times
    std::function<void(std::size_t)> floor = {};  // the same bytes filled so many times; may be empty
};

/// Medians over the samples of a case.
struct Medians {
    double nanoseconds = 0;  ///< of one call of the work
    double of_floor = 0;     ///< the floor's time / the work's time, sample by sample; 0 without a floor
};

/// Runs `task` for as long as `state` wants. Iterations and the time that Google Benchmark prints are those
/// of one call of the work.
[[nodiscard]] Medians measure(benchmark::State& state, const Task& task);

/// The least batch that makes a sample of calls of `vertices` vertices each long enough.
[[nodiscard]] std::size_t batch_for(std::size_t vertices);

/// Sets the counters ns_per_vertex, bytes_per_second (bytes written; 0 bytes: left out) and, where there is
/// a floor, of_floor. `vertices` and `bytes` are those of one call.
void report(benchmark::State& state, const Medians& medians, std::size_t vertices, std::size_t bytes = 0);

}  // namespace goffer::bench
