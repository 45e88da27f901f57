// SPDX-License-Identifier: MIT
#include "crowd/timing.hpp"

#include "progress.hpp"

#include <goffer/measure/allocations.hpp>
#include <goffer/measure/timer.hpp>

#include <tbb/task_arena.h>

#include <cstdint>
#include <vector>

namespace goffer::cli {
namespace {

constexpr std::size_t warm_up = 3;
constexpr std::size_t frames_per_fill = 8;

/// Runs frames and keeps what they took.
class Stopwatch {
public:
    Stopwatch(Crowd& crowd, std::size_t frames, int threads, Progress& progress)
        : crowd_(crowd), frames_(frames), threads_(threads), progress_(progress) {
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
            progress_.advance();
        }
    }

    [[nodiscard]] Timing timing() const {
        Timing timing{.frame_median = measure::median(frame_times_),
                      .frame_p99 = measure::quantile(frame_times_, 0.99),
                      .fill_median = measure::median(fill_times_),
                      .clamped = clamped_};
        if (measure::allocations())
            timing.allocations = static_cast<double>(allocations_) / static_cast<double>(frames_);
        return timing;
    }

private:
    double run_frame(std::size_t frame) {
        crowd_.set_poses(frame);
        return 1e-6 * measure::nanoseconds_of(threads_, [&] {
                   clamped_ =
                       (threads_ > 1 ? bend::run_parallel(crowd_.job()) : bend::run(crowd_.job())).clamped;
               });
    }

    void time_frame(std::size_t frame) {
        const std::uint64_t before = measure::allocations().value_or(0);
        const double time = run_frame(frame);
        allocations_ += measure::allocations().value_or(0) - before;
        frame_times_.push_back(time);
    }

    void fill(float value) {
        fill_times_.push_back(1e-6 *
                              measure::nanoseconds_of(threads_, [&] { crowd_.fill(value, threads_); }));
    }

    Crowd& crowd_;
    std::size_t frames_;
    int threads_;
    Progress& progress_;
    std::vector<double> frame_times_;
    std::vector<double> fill_times_;
    std::uint64_t allocations_ = 0;
    std::size_t clamped_ = 0;
};

}  // namespace

Timing measure(Crowd& crowd, std::size_t frames, int threads, Progress& progress) {
    Stopwatch stopwatch(crowd, frames, threads, progress);
    if (threads > 1) {
        tbb::task_arena(threads).execute([&] { stopwatch.run(); });
    } else {
        stopwatch.run();
    }
    return stopwatch.timing();
}

}  // namespace goffer::cli
