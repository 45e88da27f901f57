// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <goffer/measure/timer.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace goffer::bench {
namespace {

/// Nanoseconds of one call.
double timed(const std::function<void(std::size_t)>& work, const Task& task) {
    return measure::nanoseconds_of(task.threads, [&] { work(task.batch); }) / static_cast<double>(task.batch);
}

}  // namespace

Medians measure(benchmark::State& state, const Task& task) {
    std::vector<double> times;
    std::vector<double> ratios;
    while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(task.batch))) {
        state.PauseTiming();
        if (task.prepare) task.prepare();
        state.ResumeTiming();
        const double time = timed(task.work, task);
        state.PauseTiming();
        times.push_back(time);
        if (task.floor) ratios.push_back(timed(task.floor, task) / time);
        state.ResumeTiming();
    }
    return {measure::median(std::move(times)), measure::median(std::move(ratios))};
}

std::size_t batch_for(std::size_t vertices) {
    constexpr std::size_t vertices_of_a_sample = 200'000;  // a tenth of a millisecond, or more
    return std::max<std::size_t>(1, vertices_of_a_sample / vertices);
}

void report(benchmark::State& state, const Medians& medians, std::size_t vertices, std::size_t bytes) {
    state.counters["ns_per_vertex"] = medians.nanoseconds / static_cast<double>(vertices);
    if (bytes != 0)
        state.counters["bytes_per_second"] = static_cast<double>(bytes) / medians.nanoseconds * 1e9;
    if (medians.of_floor != 0) state.counters["of_floor"] = medians.of_floor;
}

}  // namespace goffer::bench
