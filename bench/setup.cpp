// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "layout.hpp"
#include "measure.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/job.hpp>

#include <cmath>
#include <vector>

namespace goffer::bench {
namespace {

constexpr std::size_t vertices = 10'000;
constexpr std::size_t instances = 1000;

/// Instances in poses of their own.
std::vector<bend::DeformJob> make_jobs(Stage& stage) {
    const Layout& streams = layout("positions+normals");
    const CrowdMemory memory{stage.memory(vertices * streams.footprint()).data(), vertices};
    std::vector<bend::DeformJob> jobs(instances);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto at = static_cast<float>(i);
        jobs[i].body = &stage.body(vertices);
        jobs[i].pose = {1.0f + 0.5f * std::sin(at), at};
        set_streams(jobs[i], streams, memory, 0);  // the same for all: nothing is written
    }
    return jobs;
}

/// Times `call(job)` over many instances, one after the other.
template <class Call>
void time_instances(benchmark::State& state, Stage& stage, const Call& call) {
    const std::vector<bend::DeformJob> jobs = make_jobs(stage);
    const Task task{.batch = 4 * instances, .work = [&](std::size_t count) {
                        for (std::size_t i = 0; i < count; ++i) {
                            auto result = call(jobs[i % instances]);
                            benchmark::DoNotOptimize(result);
                        }
                    }};
    state.counters["ns_per_instance"] = measure(state, task).nanoseconds;
}

void instance(benchmark::State& state, Stage& stage) {
    time_instances(state, stage, [](const bend::DeformJob& job) { return bend::run_range(job, 0, 0); });
}

void bounds(benchmark::State& state, Stage& stage) {
    time_instances(state, stage, [](const bend::DeformJob& job) { return bend::bounds(job); });
}

}  // namespace

void register_setup(Stage& stage) {
    benchmark::RegisterBenchmark("setup/instance", instance, std::ref(stage));
    benchmark::RegisterBenchmark("setup/bounds", bounds, std::ref(stage));
}

}  // namespace goffer::bench
