// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/fault.hpp>
#include <goffer/bend/packed.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/engine/isa.hpp>
#include <goffer/engine/streams.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

/// The job: one instance of a body, deformed into the caller's memory. (Many at once: crowd.hpp.)
///
///     bend::DeformJob job{.body = &body, .pose = {.angle = 1.2f}};
///     job.positions = interleaved<3>(&vertices[0].x, body.vertex_count(), sizeof(Vertex));
///     if (const bend::Fault fault = bend::validate(job); !fault.none()) {
///         std::puts(bend::describe(fault).c_str());
///     } else {
///         bend::run(job);
///     }
///
/// Method: Chen et al. 2015, eq 2-10, in the stable form of goffer::paper::ClosedForm, in float.
/// See modules/paper/README.md, "Bend".

namespace goffer::bend {

/// An axis-aligned box.
struct Bounds {
    glm::vec3 low{0};
    glm::vec3 high{0};
};

/// Inputs and outputs of one deformation. A plain value; everything it points to is the caller's.
///
/// Outputs are written and never read, so they may lie in write-combined memory. No two of them may share a
/// byte, and none may share one with an input; members of the same records at different offsets don't.
struct DeformJob {
    const Body* body = nullptr;  ///< must outlive the run
    Pose pose = {};              ///< of a body of one region
    /// One per region of the body, from base to tip, each as `pose`, which is then not read. Empty: `pose`.
    std::span<const Pose> poses = {};
    /// From 1, wrinkles as deep as keeps the area, to 0, the bare bend, which takes less time: for instances
    /// too far away to show more, faded out on the way.
    float wrinkle_weight = 1;
    /// From model space to the space of all outputs: an instance's model matrix, if vertices are wanted in
    /// world space. Any numbers up to 1e18; scale, shear and mirroring included. Costs nothing per vertex.
    glm::mat4x3 transform{1};

    Stream3 positions = {};    ///< empty: not wanted
    Stream3 normals = {};      ///< unit length; empty: not wanted
    Stream4 tangents = {};     ///< unit length, w the rest tangent's (negated where `transform` mirrors);
                               ///< needs a body with tangents
    PackedStream packed = {};  ///< position and normal in 12 bytes, in bounds(job)
    Bounds* bounds = nullptr;  ///< null, or where a run leaves bounds(job)

    /// Positions at another pose, the last frame's for motion vectors; with the same wrinkle_weight.
    Stream3 previous_positions = {};
    Pose previous_pose = {};                    ///< as `pose`
    std::span<const Pose> previous_poses = {};  ///< as `poses`
    glm::mat4x3 previous_transform{1};          ///< as `transform`

    /// What lies between the outputs of a record, up to the next record, is never written: it may hold data
    /// of the caller's. Set this where it doesn't matter: records are then written as whole cache lines,
    /// which takes a fraction of the time. Bytes before the first output of the first vertex and after the
    /// last output of the last one stay as they are all the same.
    bool scratch_gaps = false;
    Isa isa = Isa::automatic;  ///< kernels to use
};

/// The first fault of `job`, or none. A job without fault cannot make run() read or write out of bounds. Does
/// not allocate. Thread-safe.
[[nodiscard]] Fault validate(const DeformJob& job) noexcept;

/// What a run did.
struct DeformResult {
    bool clamped = false;  ///< an angle was beyond body->max_angle(region) and was clamped to it
    bool at_rest = false;  ///< a pose had a number that is not finite: all regions were taken as at rest
};

/// Deforms all vertices on the calling thread. `job` must validate, but for its poses, which may hold any
/// bits. Does not allocate, lock or log. Thread-safe where outputs do not overlap. The bits of the result
/// depend on job.isa and on nothing else.
DeformResult run(const DeformJob& job) noexcept;

/// Deforms the vertices [first, last), first <= last <= body->vertex_count(), on the calling thread: what any
/// scheduler can call. Otherwise as run(); the union of ranges gives the same bits as run(), and `bounds` are
/// left by the range that begins at 0.
DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept;

/// Deforms all vertices with oneTBB in the caller's arena (in a build with GOFFER_TBB=OFF: on the calling
/// thread), in ranges of half of `grain` vertices or more. The same bits as run(). Worth it for a large body;
/// a crowd is better split by instance. The scheduler may allocate.
DeformResult run_parallel(const DeformJob& job, std::size_t grain = 8192);

}  // namespace goffer::bend
