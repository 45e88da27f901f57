// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "layout.hpp"
#include "measure.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/path.hpp>

#include <glm/vec3.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace goffer::bench {
namespace {

constexpr std::size_t vertices = 10'000;
constexpr std::size_t instances = 1000;

std::vector<bend::Pose> make_poses(std::size_t count) {
    std::vector<bend::Pose> poses(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<float>(i);
        poses[i] = {1.0f + 0.5f * std::sin(at), at};
    }
    return poses;
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
    const StreamLayout& streams = layout("positions+normals");
    const CrowdMemory memory{fixture.memory(vertices * streams.footprint()).data(), vertices};
    const std::vector<bend::Pose> poses = make_poses(instances);
    std::vector<bend::DeformJob> jobs(instances);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        jobs[i].body = &fixture.body(vertices);
        jobs[i].pose = poses[i];
        set_streams(jobs[i], streams, memory, 0);  // the same for all: nothing is written
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

void bounds_batch(benchmark::State& state, Fixture& fixture) {
    const std::vector<bend::Pose> poses = make_poses(instances);
    std::vector<bend::Bounds> result(instances);
    bend::Batch batch{.body = &fixture.body(vertices), .count = instances};
    batch.poses = strided(std::span(poses));
    const Task task{.batch = 4, .work = [&](std::size_t times) {
                        for (std::size_t i = 0; i < times; ++i) {
                            bend::bounds(batch, result);
                            benchmark::ClobberMemory();
                        }
                    }};
    state.counters["ns_per_instance"] = measure(state, task).nanoseconds / instances;
}

/// Instances of a small body.
class SmallCrowd {
public:
    SmallCrowd(const bend::Body& body, const std::vector<bend::Pose>& poses, std::span<float> memory) {
        const StreamLayout& streams = layout("positions+normals");
        batch_.body = &body;
        batch_.count = poses.size();
        batch_.poses = strided(std::span(poses));
        batch_.vertex_step = body.vertex_count();
        set_streams(batch_, streams, {memory.data(), memory.size() / streams.floats});
    }

    [[nodiscard]] bend::CrowdJob job() const { return {.batches = {&batch_, 1}}; }

private:
    bend::Batch batch_;
};

/// What an instance in a batch costs beside its vertices: what would be left of a small body without any,
/// from one of twice as many, which is run next to it in the floor's place.
void batch(benchmark::State& state, Fixture& fixture) {
    constexpr std::size_t few = 64, count = 256;
    const std::span<float> memory = fixture.memory(2 * few * count * layout("positions+normals").floats);
    const std::vector<bend::Pose> poses = make_poses(count);
    const SmallCrowd once(fixture.body(few), poses, memory), twice(fixture.body(2 * few), poses, memory);
    if (const bend::Fault fault = bend::validate(twice.job()); !fault.none()) {
        state.SkipWithError(bend::describe(fault).c_str());
        return;
    }
    const auto running = [](const SmallCrowd& crowd) {
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
    const bend::Body& body = fixture.body(vertices, Shape::regions16);
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
    benchmark::RegisterBenchmark("setup/path", path, std::ref(fixture));
}

}  // namespace goffer::bench
