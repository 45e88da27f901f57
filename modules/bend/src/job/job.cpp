// SPDX-License-Identifier: MIT
#include "pose/instance.hpp"
#include "job/run.hpp"
#include "job/streams_wanted.hpp"

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

JobFault check(const PackedStream& stream, std::size_t vertices) noexcept {
    if (reinterpret_cast<std::uintptr_t>(stream.first) % alignof(float) != 0) return JobFault::packed_first;
    if (stream.stride < sizeof(PackedVertex) || stream.stride % sizeof(float) != 0) {
        return JobFault::packed_stride;
    }
    return stream.count < vertices ? JobFault::packed_count : JobFault::none;
}

/// Squares of its numbers, and sums of such, stay within float's range.
bool usable(const glm::mat4x3& matrix) noexcept {
    for (int c = 0; c < 4; ++c) {
        for (int row = 0; row < 3; ++row) {
            if (!(std::fabs(matrix[c][row]) <= 1e18f)) return false;
        }
    }
    return true;
}

struct PoseFaults {
    JobFault count, angle, direction;
};

/// `poses`, or `pose` where there are none.
JobFault check(const Body& body, const Pose& pose, std::span<const Pose> poses,
               const PoseFaults& faults) noexcept {
    const std::span<const Pose> used = poses.empty() ? std::span<const Pose>(&pose, 1) : poses;
    if (used.size() != body.region_count()) return faults.count;
    for (const Pose& one : used) {
        if (!std::isfinite(one.angle)) return faults.angle;
        if (!std::isfinite(one.direction)) return faults.direction;
    }
    return JobFault::none;
}

JobFault check_previous(const DeformJob& job) noexcept {
    const JobFault fault = check(
        *job.body, job.previous_pose, job.previous_poses,
        {JobFault::previous_poses_count, JobFault::previous_pose_angle, JobFault::previous_pose_direction});
    if (fault != JobFault::none) return fault;
    if (!usable(job.previous_transform)) return JobFault::previous_transform;
    return check(job.previous_positions, job.body->vertex_count(),
                 {JobFault::previous_positions_count, JobFault::previous_positions_stride,
                  JobFault::previous_positions_component});
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
            return "positions, normals, tangents, packed, previous_positions: all empty, nothing to write";
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
        case JobFault::transform:
            return "transform: a number in it not finite, or beyond 1e18";
        case JobFault::packed_count:
            return "packed.count: below the body's vertex_count()";
        case JobFault::packed_stride:
            return "packed.stride: below 12, or not a multiple of 4";
        case JobFault::packed_first:
            return "packed.first: not aligned to 4 bytes";
        case JobFault::previous_pose_angle:
            return "previous_pose.angle: not finite";
        case JobFault::previous_pose_direction:
            return "previous_pose.direction: not finite";
        case JobFault::previous_transform:
            return "previous_transform: a number in it not finite, or beyond 1e18";
        case JobFault::previous_positions_count:
            return "previous_positions.count: below the body's vertex_count()";
        case JobFault::previous_positions_stride:
            return "previous_positions.stride: not a multiple of 4, or below 4 (12 for interleaved)";
        case JobFault::previous_positions_component:
            return "previous_positions.component: null, or not aligned to 4 bytes";
        case JobFault::poses_count:
            return "poses: not one per region of the body (pose alone is for a body of one region)";
        case JobFault::previous_poses_count:
            return "previous_poses: not one per region of the body (previous_pose alone is for a body of one "
                   "region)";
    }
    return "unknown fault";
}

JobFault validate(const DeformJob& job) noexcept {
    if (job.body == nullptr) return JobFault::body;
    const JobFault pose_fault =
        check(*job.body, job.pose, job.poses,
              {JobFault::poses_count, JobFault::pose_angle, JobFault::pose_direction});
    if (pose_fault != JobFault::none) return pose_fault;
    if (!usable(job.transform)) return JobFault::transform;
    const bool packed = !job.packed.empty();
    const bool previous = !job.previous_positions.empty();
    if (streams_wanted(job) == 0 && !packed && !previous) return JobFault::no_streams;
    const std::size_t vertices = job.body->vertex_count();
    const JobFault faults[] = {
        check(job.positions, vertices,
              {JobFault::positions_count, JobFault::positions_stride, JobFault::positions_component}),
        check(job.normals, vertices,
              {JobFault::normals_count, JobFault::normals_stride, JobFault::normals_component}),
        check(job.tangents, vertices,
              {JobFault::tangents_count, JobFault::tangents_stride, JobFault::tangents_component}),
        packed ? check(job.packed, vertices) : JobFault::none,
        previous ? check_previous(job) : JobFault::none,
    };
    for (const JobFault fault : faults) {
        if (fault != JobFault::none) return fault;
    }
    if (!job.tangents.empty() && !job.body->has_tangents()) return JobFault::body_without_tangents;
    return runs_here(job.isa) ? JobFault::none : JobFault::isa;
}

DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept {
    PreparedPass passes[pass_count];
    const PreparedJob prepared = prepare(job, passes, first == 0);
    by_region(passes, prepared.passes, first, last, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = 0; i < prepared.passes; ++i) run_pass(passes[i], begin, end, false);
    });
    return {prepared.clamped};
}

DeformResult run(const DeformJob& job) noexcept {
    return run_range(job, 0, job.body->vertex_count());
}

DeformResult run_parallel(const DeformJob& job, std::size_t grain) {
    parallel_ranges(job.body->vertex_count(), grain,
                    [&](std::size_t first, std::size_t last) { run_range(job, first, last); });
    return {is_clamped(*job.body, poses_of(job))};
}

}  // namespace goffer::bend
