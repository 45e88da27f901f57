// SPDX-License-Identifier: MIT
#include "instance.hpp"
#include "run.hpp"
#include "streams_wanted.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/engine/parallel.hpp>

#include <cmath>

namespace goffer::bend {
namespace {

struct StreamFaults {
    JobFault count, stride, component;
};

template <std::size_t N>
JobFault check(const Stream<N>& stream, std::size_t vertices, const StreamFaults& faults) noexcept {
    if (stream.empty()) return JobFault::none;
    for (const float* component : stream.component) {
        if (component == nullptr || reinterpret_cast<std::uintptr_t>(component) % alignof(float) != 0) {
            return faults.component;
        }
    }
    const bool together = vertices > 1 && stream.component[1] == stream.component[0] + 1;
    const std::size_t least = together ? N * sizeof(float) : sizeof(float);
    if (stream.stride < least || stream.stride % sizeof(float) != 0) return faults.stride;
    return stream.count < vertices ? faults.count : JobFault::none;
}

}  // namespace

std::string_view describe(JobFault fault) noexcept {
    switch (fault) {
        case JobFault::none:
            return "no fault";
        case JobFault::body:
            return "body: null";
        case JobFault::pose_angle:
            return "pose.angle: not finite";
        case JobFault::pose_direction:
            return "pose.direction: not finite";
        case JobFault::no_streams:
            return "positions, normals, tangents: all empty, nothing to write";
        case JobFault::positions_count:
            return "positions.count: below the body's vertex_count()";
        case JobFault::positions_stride:
            return "positions.stride: not a multiple of 4, or below 4 (12 for interleaved)";
        case JobFault::positions_component:
            return "positions.component: null, or not aligned to 4 bytes";
        case JobFault::normals_count:
            return "normals.count: below the body's vertex_count()";
        case JobFault::normals_stride:
            return "normals.stride: not a multiple of 4, or below 4 (12 for interleaved)";
        case JobFault::normals_component:
            return "normals.component: null, or not aligned to 4 bytes";
        case JobFault::tangents_count:
            return "tangents.count: below the body's vertex_count()";
        case JobFault::tangents_stride:
            return "tangents.stride: not a multiple of 4, or below 4 (16 for interleaved)";
        case JobFault::tangents_component:
            return "tangents.component: null, or not aligned to 4 bytes";
        case JobFault::body_without_tangents:
            return "tangents: asked for, but the body was bound without tangents";
        case JobFault::isa:
            return "isa: not built, or not supported by this processor";
    }
    return "unknown fault";
}

JobFault validate(const DeformJob& job) noexcept {
    if (job.body == nullptr) return JobFault::body;
    if (!std::isfinite(job.pose.angle)) return JobFault::pose_angle;
    if (!std::isfinite(job.pose.direction)) return JobFault::pose_direction;
    if (streams_wanted(job) == 0) return JobFault::no_streams;
    const std::size_t vertices = job.body->vertex_count();
    JobFault fault =
        check(job.positions, vertices,
              {JobFault::positions_count, JobFault::positions_stride, JobFault::positions_component});
    if (fault != JobFault::none) return fault;
    fault = check(job.normals, vertices,
                  {JobFault::normals_count, JobFault::normals_stride, JobFault::normals_component});
    if (fault != JobFault::none) return fault;
    fault = check(job.tangents, vertices,
                  {JobFault::tangents_count, JobFault::tangents_stride, JobFault::tangents_component});
    if (fault != JobFault::none) return fault;
    if (!job.tangents.empty() && !job.body->has_tangents()) return JobFault::body_without_tangents;
    return runs_here(job.isa) ? JobFault::none : JobFault::isa;
}

DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept {
    DeformResult result;
    const Coefficients coefficients = prepare(*job.body, job.pose, result.clamped);
    run_prepared(job, coefficients, first, last, false);
    return result;
}

DeformResult run(const DeformJob& job) noexcept {
    return run_range(job, 0, job.body->vertex_count());
}

DeformResult run_parallel(const DeformJob& job, std::size_t grain) {
    DeformResult result;
    const Coefficients coefficients = prepare(*job.body, job.pose, result.clamped);
    parallel_ranges(job.body->vertex_count(), grain, [&](std::size_t first, std::size_t last) {
        run_prepared(job, coefficients, first, last, false);
    });
    return result;
}

}  // namespace goffer::bend
