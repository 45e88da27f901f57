// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/packed.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/engine/isa.hpp>
#include <goffer/engine/streams.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
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

/// An axis-aligned box.
struct Bounds {
    glm::vec3 low{0};
    glm::vec3 high{0};
};

/// Inputs and outputs of one deformation. A plain value; everything it points to is the caller's.
struct DeformJob {
    const Body* body = nullptr;  ///< must outlive the run
    Pose pose = {};              ///< of a body of one region; both numbers finite
    /// One per region of the body, from base to tip, each as `pose`, which is then not read. Empty: `pose`.
    std::span<const Pose> poses = {};
    bool wrinkles = true;  ///< false: the bare bend, in less time, for instances too far away to show more
    /// From model space to the space of all outputs: an instance's model matrix, if vertices are wanted in
    /// world space. Any numbers up to 1e18; scale, shear and mirroring included. Costs nothing per vertex.
    glm::mat4x3 transform{1};

    Stream3 positions = {};    ///< empty: not wanted
    Stream3 normals = {};      ///< unit length; empty: not wanted
    Stream4 tangents = {};     ///< unit length, w the rest tangent's (negated where `transform` mirrors);
                               ///< needs a body with tangents
    PackedStream packed = {};  ///< position and normal in 12 bytes, in bounds(job)
    Bounds* bounds = nullptr;  ///< null, or where a run leaves bounds(job)

    /// Positions at another pose, the last frame's for motion vectors. Costs as much as positions do.
    Stream3 previous_positions = {};
    Pose previous_pose = {};                    ///< as `pose`
    std::span<const Pose> previous_poses = {};  ///< as `poses`
    glm::mat4x3 previous_transform{1};          ///< as `transform`

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
    transform,
    packed_count,
    packed_stride,
    packed_first,
    previous_pose_angle,
    previous_pose_direction,
    previous_transform,
    previous_positions_count,
    previous_positions_stride,
    previous_positions_component,
    poses_count,
    previous_poses_count,
};

/// One line on `fault`, in static storage. Thread-safe.
[[nodiscard]] std::string_view describe(JobFault fault) noexcept;

/// The first fault of `job`, or none. A job without fault cannot make run() read or write out of bounds. Does
/// not allocate. Thread-safe.
[[nodiscard]] JobFault validate(const DeformJob& job) noexcept;

/// What a run did.
struct DeformResult {
    bool clamped = false;  ///< an angle was beyond body->max_angle(region) and was clamped to it
};

/// Deforms all vertices on the calling thread. `job` must validate. Does not allocate, lock or log.
/// Thread-safe where outputs do not overlap. The bits of the result depend on job.isa and on nothing else.
DeformResult run(const DeformJob& job) noexcept;

/// Deforms the vertices [first, last), first <= last <= body->vertex_count(), on the calling thread: what any
/// scheduler can call. Otherwise as run(); the union of ranges gives the same bits as run(), and `bounds` are
/// left by the range that begins at 0.
DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept;

/// Deforms all vertices with oneTBB in the caller's arena (in a build with GOFFER_TBB=OFF: on the calling
/// thread), in ranges of `grain` vertices or more. The same bits as run(). Worth it for a large body; a crowd
/// is better split by instance. The scheduler may allocate.
DeformResult run_parallel(const DeformJob& job, std::size_t grain = 8192);

}  // namespace goffer::bend
