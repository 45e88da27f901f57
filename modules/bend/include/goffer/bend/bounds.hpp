// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <span>

/// Bounds of a deformed instance from its pose alone, before any vertex is touched: for culling, and as the
/// frame of the packed stream.
///
/// Poses may hold any bits. An angle beyond a region's max_angle is clamped, and an instance with a pose that
/// is not finite is taken as at rest, as in a run. The functions do not allocate and are thread-safe.

namespace goffer::bend {

struct Batch;

/// A box that holds every vertex of `body` at `pose`, with full wrinkles, under `transform` (from model space
/// to the box's space). `body` is not empty; `pose` is that of its first region, and other regions are at
/// rest. A transform that is not finite gives a box that is not, or an empty one, whose low is above its
/// high.
///
/// The box is conservative: for round bodies at most 1.3 times as long as the tight box on each axis, 1.7
/// times where folds are deeper than the radius, before the margin. It is that of eleven bands of each
/// region, each of which sweeps its widest cross-section along its piece of the arc, plus a margin for
/// rounding: 1e-5 of a region's length and, of the farthest that vertices reach from the center line, 1e-6
/// and 2e-7 for each radian that it bends, both under the transform, and 1e-6 of how far the region's middle
/// is from the origin along the axis; for bodies with a shape also the error of the stored drift.
///
/// The depth of wrinkles is looked up at some columns, and taken to grow between them toward the inner line,
/// as it does in all tables that fit makes. With a table of the caller's own in which it rises and falls
/// again, vertices may lie outside the box, by as much as was missed.
[[nodiscard]] Bounds bounds(const Body& body, const Pose& pose,
                            const glm::mat4x3& transform = glm::mat4x3(1)) noexcept;

/// The same for a body of several regions: `poses` has one for each, from base to tip. Regions after the last
/// pose are at rest.
[[nodiscard]] Bounds bounds(const Body& body, std::span<const Pose> poses,
                            const glm::mat4x3& transform = glm::mat4x3(1)) noexcept;

/// The bounds at a job's current poses, transform and wrinkle_weight: those that its packed stream is encoded
/// in. job.body is neither null nor empty; outputs are not read.
[[nodiscard]] Bounds bounds(const DeformJob& job) noexcept;

/// The bounds of every instance of `batch`, whatever its masks say, for culling before the masks are known.
/// result[i] is that of instance i; `result` is the caller's and holds batch.count or more. batch.body is
/// neither null nor empty, and batch.poses is given; outputs are not read. `isa` runs here.
void bounds(const Batch& batch, std::span<Bounds> result, Isa isa = Isa::automatic) noexcept;

/// The bounds of every job: result[i] is that of jobs[i]. `result` is the caller's and holds as many or more.
void bounds(std::span<const DeformJob> jobs, std::span<Bounds> result) noexcept;

}  // namespace goffer::bend
