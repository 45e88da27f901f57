// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/engine/isa.hpp>
#include <goffer/engine/streams.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

/// The job: one instance of a body, deformed into the caller's memory.
///
///     bend::DeformJob job{.body = &body, .pose = {.angle = 1.2f}};
///     job.positions = interleaved<3>(vertices, body.vertex_count(), sizeof(Vertex));
///     if (const auto fault = bend::validate(job); fault != bend::JobFault::none)
///     puts(describe(fault).data()); bend::run(job);
///
/// Method: Chen et al. 2015, eq 2-10, in the stable form of goffer::paper::ClosedForm, in float.

namespace goffer::bend {

/// Inputs and outputs of one deformation. A plain value; everything it points to is the caller's.
struct DeformJob {
    const Body* body = nullptr;  ///< must outlive the run
    Pose pose = {};              ///< both numbers finite
    Stream3 positions = {};      ///< model space, model units; empty: not wanted
    Stream3 normals = {};        ///< model space, unit length; empty: not wanted
    Stream4 tangents = {};  ///< model space, unit length, w is the rest tangent's; needs a body with tangents
    Isa isa = Isa::automatic;  ///< kernels to use
};

/// What is wrong with a job. describe() names the field and what it should be.
enum class JobFault : std::uint8_t {
    none,
    body,
    pose_angle,
    pose_direction,
    no_streams,
    positions_count,
    positions_stride,
    positions_component,
    normals_count,
    normals_stride,
    normals_component,
    tangents_count,
    tangents_stride,
    tangents_component,
    body_without_tangents,
    isa,
};

/// One line on `fault`, in static storage. Thread-safe.
[[nodiscard]] std::string_view describe(JobFault fault) noexcept;

/// The first fault of `job`, or none. A job without fault cannot make run() read or write out of bounds. Does
/// not allocate. Thread-safe.
[[nodiscard]] JobFault validate(const DeformJob& job) noexcept;

/// What a run did.
struct DeformResult {
    bool clamped = false;  ///< the pose's angle was beyond body->max_angle() and was clamped to it
};

/// Deforms all vertices on the calling thread. `job` must validate. Does not allocate, lock or log.
/// Thread-safe where outputs do not overlap. The bits of the result depend on job.isa and on nothing else.
DeformResult run(const DeformJob& job) noexcept;

/// Deforms the vertices [first, last), first <= last <= body->vertex_count(), on the calling thread: what any
/// scheduler can call. Otherwise as run(); the union of ranges gives the same bits as run().
DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept;

/// Deforms all vertices with oneTBB in the caller's arena, in ranges of `grain` vertices or more. The same
/// bits as run(). Worth it for a large body; a crowd is better split by instance. The scheduler may allocate.
DeformResult run_parallel(const DeformJob& job, std::size_t grain = 8192);

}  // namespace goffer::bend
