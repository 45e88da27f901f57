// SPDX-License-Identifier: MIT
#include "crowd_measure.hpp"

#include "allocations.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace goffer::cli {
namespace {

constexpr std::size_t warm_up = 3;
constexpr std::size_t frames_per_fill = 8;

/// The smallest of `times` that `share` of them do not exceed.
double quantile(std::vector<double> times, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(times.size())));
    const auto at = times.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(times.begin(), at, times.end());
    return *at;
}

template <class Work>
double milliseconds(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Runs frames and keeps what they took.
class Stopwatch {
public:
    Stopwatch(Crowd& crowd, std::size_t frames, bool parallel)
        : crowd_(crowd), frames_(frames), parallel_(parallel) {
        frame_times_.reserve(frames);
        fill_times_.reserve(frames / frames_per_fill + 1);
    }

    void run() {
        for (std::size_t i = 0; i < warm_up; ++i) run_frame(i);
        for (std::size_t i = 0; i < frames_; ++i) {
            if (i % frames_per_fill == 0) {
                fill(static_cast<float>(i));
                run_frame(i);
            }
            time_frame(i);
        }
    }

    [[nodiscard]] Timing timing() const {
        Timing timing{.frame_median = quantile(frame_times_, 0.5),
                      .frame_p99 = quantile(frame_times_, 0.99),
                      .fill_median = quantile(fill_times_, 0.5),
                      .clamped = clamped_};
        if (cli::allocations())
            timing.allocations = static_cast<double>(allocations_) / static_cast<double>(frames_);
        return timing;
    }

private:
    double run_frame(std::size_t frame) {
        crowd_.set_poses(frame);
        return milliseconds([&] {
            clamped_ = (parallel_ ? bend::run_parallel(crowd_.job()) : bend::run(crowd_.job())).clamped;
        });
    }

    void time_frame(std::size_t frame) {
        const std::uint64_t before = cli::allocations().value_or(0);
        const double time = run_frame(frame);
        allocations_ += cli::allocations().value_or(0) - before;
        frame_times_.push_back(time);
    }

    void fill(float value) {
        fill_times_.push_back(milliseconds([&] { crowd_.memory().fill(value, parallel_); }));
    }

    Crowd& crowd_;
    std::size_t frames_;
    bool parallel_;
    std::vector<double> frame_times_;
    std::vector<double> fill_times_;
    std::uint64_t allocations_ = 0;
    std::size_t clamped_ = 0;
};

}  // namespace

Timing measure(Crowd& crowd, std::size_t frames, int threads) {
    Stopwatch stopwatch(crowd, frames, threads > 1);
    if (threads > 1) {
        tbb::task_arena(threads).execute([&] { stopwatch.run(); });
    } else {
        stopwatch.run();
    }
    return stopwatch.timing();
}

}  // namespace goffer::cli
