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

/// The job: one instance of a body, deformed into the caller's memory. For many at once see crowd.hpp.
///
///     bend::DeformJob job{.body = &body, .pose = {.angle = 1.2f}};
///     job.positions = interleaved<3>(&vertices[0].x, body.vertex_count(), sizeof(Vertex));
///     if (const bend::Fault fault = bend::validate(job); !fault.none()) {
///         std::puts(bend::describe(fault).c_str());
///     } else {
///         bend::run(job);
///     }
///
/// The method is that of Chen et al. 2015, eq 2-10, evaluated in float in the form of paper::ClosedForm.
/// See modules/paper/README.md, "Bend".

namespace goffer::bend {

// GLM_FORCE_DEFAULT_ALIGNED_GENTYPES with GLM_FORCE_INTRINSICS gives its types other sizes, under the same
// names: the program and the library would look for members in different places.
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::mat4x3) == 48,
              "goffer's structs hold GLM's packed types: include its headers in sources that do not define "
              "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

/// An axis-aligned box.
struct Bounds {
    glm::vec3 low{0};
    glm::vec3 high{0};
};

/// Inputs and outputs of one deformation. A plain value; everything that it points to is the caller's and
/// must outlive the run.
///
/// At least one stream must be given; those left empty are not wanted. Outputs are written and never read, so
/// they may lie in write-combined memory. No two outputs may share a byte, nor may an output and an input.
struct DeformJob {
    const Body* body = nullptr;  ///< neither null nor empty
    Pose pose = {};              ///< for a body of one region
    /// One per region of the body, from base to tip; `pose` is then not read. Empty: `pose`.
    std::span<const Pose> poses = {};
    /// Factor on the depth of all wrinkles, 0..1. 1 is the depth that was bound; 0 is the bare bend, which
    /// takes less time unless the body has a shape. Lets distant instances fade their wrinkles out.
    float wrinkle_weight = 1;
    /// From model space to the space of all outputs: an instance's model matrix, if vertices are wanted in
    /// world space. Numbers up to 1e18; may scale, shear and mirror. Costs nothing per vertex.
    glm::mat4x3 transform{1};

    Stream3 positions = {};
    /// Unit length, facing outward even where `transform` mirrors. Where a transform flattens the body they
    /// may be 0, and tangents too.
    Stream3 normals = {};
    /// Unit length, under scales of 1e-14 or more. w is the rest tangent's sign, negated where `transform`
    /// mirrors. The body must have tangents.
    Stream4 tangents = {};
    PackedStream packed = {};  ///< position and normal in 12 bytes; positions are relative to bounds(job)
    Bounds* bounds = nullptr;  ///< null, or where a run writes bounds(job)

    /// Positions at another pose, with the same wrinkle_weight: those of the last frame, for motion vectors.
    Stream3 previous_positions = {};
    Pose previous_pose = {};                    ///< as `pose`
    std::span<const Pose> previous_poses = {};  ///< as `poses`
    glm::mat4x3 previous_transform{1};          ///< as `transform`

    bool scratch_gaps = false;  ///< as Batch::scratch_gaps
    Isa isa = Isa::automatic;   ///< kernels to use; must run here
};

/// Finds the first fault of `job`. A job without fault makes run() neither read nor write out of bounds, if
/// streams hold as many vertices as they say. A stream takes the bytes of all the vertices that it holds,
/// written or not. Where two streams differ in stride, an overlap of their ranges is a fault even if no byte
/// is shared; so is one of `bounds` with a stream. Inputs that share bytes with
/// outputs are not found. Does not allocate. Thread-safe.
[[nodiscard]] Fault validate(const DeformJob& job) noexcept;

/// What a run made of the current poses.
struct DeformResult {
    bool clamped = false;  ///< an angle was beyond body->max_angle(region), and all poses were finite
    bool at_rest = false;  ///< a pose was not finite: all regions were taken as at rest
};

/// Deforms all vertices on the calling thread. `job` must validate, except for its poses, weight and
/// transforms, which may hold any bits: a weight counts as the nearest in 0..1 (a NaN as 0), and transforms
/// that are not finite give infinities, and NaNs of any bits. Allocates and logs nothing, and locks in the
/// first run of a process alone; takes up to 64 KB of stack. Thread-safe where outputs do not overlap.
///
/// On one machine and with one build, the bits of the result depend on `job` and its isa alone. Processors of
/// different makers may differ in the last bits, unless the isa is scalar: see modules/README.md,
/// "Determinism".
DeformResult run(const DeformJob& job) noexcept;

/// Deforms the vertices [first, last), first <= last <= body->vertex_count(), on the calling thread, for
/// schedulers other than oneTBB. Ranges that cover all vertices leave the same bits as run(), in any order
/// and also at the same time. `bounds` is written by the range that has vertex 0. Otherwise as run().
DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept;

/// Deforms all vertices with oneTBB in the caller's arena (GOFFER_TBB=OFF: on the calling thread), in ranges
/// of at least half of `grain` vertices. The same bits as run(). For one large body; CrowdJob splits many.
/// goffer allocates nothing, but the scheduler may. Otherwise as run().
DeformResult run_parallel(const DeformJob& job, std::size_t grain = 8192);

}  // namespace goffer::bend
