// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "measure.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/bend/path.hpp>
#include <goffer/measure/crowd_scene.hpp>

#include <glm/vec3.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace goffer::bench {
namespace {

constexpr std::size_t setup_vertices = 10'000;
constexpr std::size_t instances = 1000;

/// Returns the pose of instance `index`: each has its own.
bend::Pose pose_of(std::size_t index) {
    const auto at = static_cast<float>(index);
    return {1.0f + 0.5f * std::sin(at), at};
}

/// Sets ns_per_instance: `call(i)` for i from 0 to `count` - 1, again and again.
template <class Call>
void time_each(benchmark::State& state, std::size_t count, const Call& call) {
    const Task task{.batch = 4 * instances, .work = [&](std::size_t times) {
                        for (std::size_t i = 0; i < times; ++i) {
                            auto result = call(i % count);
                            benchmark::DoNotOptimize(result);
                        }
                    }};
    state.counters["ns_per_instance"] = measure(state, task).nanoseconds;
}

/// Instances in poses of their own.
std::vector<bend::DeformJob> make_jobs(Fixture& fixture) {
    const measure::StreamLayout& layout = measure::stream_layout("positions+normals");
    const std::span<float> memory = fixture.memory(layout.memory_floats(setup_vertices));
    std::vector<bend::DeformJob> jobs(instances);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        jobs[i].body = &fixture.body(setup_vertices);
        jobs[i].pose = pose_of(i);
        // The same for all: nothing is written.
        measure::set_streams(jobs[i], layout, memory, 0, setup_vertices);
    }
    return jobs;
}

void instance(benchmark::State& state, Fixture& fixture) {
    const std::vector<bend::DeformJob> jobs = make_jobs(fixture);
    time_each(state, instances, [&](std::size_t i) { return bend::run_range(jobs[i], 0, 0); });
}

void bounds(benchmark::State& state, Fixture& fixture) {
    const std::vector<bend::DeformJob> jobs = make_jobs(fixture);
    time_each(state, instances, [&](std::size_t i) { return bend::bounds(jobs[i]); });
}

/// Sets ns_per_instance of `call(batch, result)`, for a batch of instances in poses of their own.
template <class Result, class Call>
void time_batch(benchmark::State& state, Fixture& fixture, const Call& call) {
    std::vector<bend::Pose> poses(instances);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = pose_of(i);
    std::vector<Result> result(instances);
    bend::Batch batch{.body = &fixture.body(setup_vertices), .count = instances};
    batch.poses = strided(std::span(poses));
    const Task task{.batch = 4, .work = [&](std::size_t times) {
                        for (std::size_t i = 0; i < times; ++i) {
                            call(batch, result);
                            benchmark::ClobberMemory();
                        }
                    }};
    state.counters["ns_per_instance"] = measure(state, task).nanoseconds / instances;
}

void bounds_batch(benchmark::State& state, Fixture& fixture) {
    time_batch<bend::Bounds>(state, fixture, [](const bend::Batch& batch, std::span<bend::Bounds> result) {
        bend::bounds(batch, result);
    });
}

/// What a shader needs of an instance.
void coefficients(benchmark::State& state, Fixture& fixture) {
    time_batch<bend::Coefficients>(
        state, fixture,
        [](const bend::Batch& batch, std::span<bend::Coefficients> result) { bend::set_up(batch, result); });
}

/// A crowd of instances without a vertex between them, in poses of their own, on `memory`.
measure::CrowdScene make_crowd(const bend::Body& body, std::size_t count, const measure::StreamLayout& layout,
                               std::span<float> memory) {
    measure::CrowdScene crowd({{&body, count, body.vertex_count()}}, layout, memory);
    crowd.set_poses([](std::size_t instance, std::span<bend::Pose> poses) { poses[0] = pose_of(instance); });
    return crowd;
}

/// What an instance in a batch costs beside its vertices: what would be left of a small body without any,
/// from one of twice as many, which is run next to it in the floor's place.
void batch(benchmark::State& state, Fixture& fixture) {
    constexpr std::size_t few = 64, count = 256;
    const measure::StreamLayout& layout = measure::stream_layout("positions+normals");
    const std::span<float> memory = fixture.memory(layout.memory_floats(2 * few * count));
    const measure::CrowdScene once = make_crowd(fixture.body(few), count, layout, memory);
    const measure::CrowdScene twice = make_crowd(fixture.body(2 * few), count, layout, memory);
    if (const bend::Fault fault = bend::validate(twice.job()); !fault.none()) {
        state.SkipWithError(bend::describe(fault).c_str());
        return;
    }
    const auto running = [](const measure::CrowdScene& crowd) {
        return [&crowd](std::size_t times) {
            for (std::size_t i = 0; i < times; ++i) {
                bend::run(crowd.job());
                benchmark::ClobberMemory();
            }
        };
    };
    const Medians medians = measure(state, {.batch = 16, .work = running(once), .floor = running(twice)});
    state.counters["ns_per_instance"] = medians.nanoseconds * (2 - medians.of_floor) / count;
}

void path(benchmark::State& state, Fixture& fixture) {
    constexpr std::size_t curves = 64, regions = 16;
    std::vector<glm::vec3> points(4 * curves);  // about as long as the body, each turning its own way
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto at = static_cast<float>(i), along = static_cast<float>(i % 4);
        points[i] = {std::sin(2 * at), std::cos(3 * at), 3.5f * along};
    }
    const bend::Body& body = fixture.body(setup_vertices, Shape::regions16);
    bend::Pose poses[regions];
    time_each(state, curves, [&](std::size_t i) {
        const glm::vec3* const p = &points[4 * i];
        return bend::poses_along_bezier(body, {p[0], p[1], p[2], p[3]}, poses);
    });
}

}  // namespace

void register_setup(Fixture& fixture) {
    benchmark::RegisterBenchmark("setup/instance", instance, std::ref(fixture));
    benchmark::RegisterBenchmark("setup/batch", batch, std::ref(fixture));
    benchmark::RegisterBenchmark("setup/bounds", bounds, std::ref(fixture));
    benchmark::RegisterBenchmark("setup/bounds_batch", bounds_batch, std::ref(fixture));
    benchmark::RegisterBenchmark("setup/coefficients", coefficients, std::ref(fixture));
    benchmark::RegisterBenchmark("setup/path", path, std::ref(fixture));
}

}  // namespace goffer::bench
