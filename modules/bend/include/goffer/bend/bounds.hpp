// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <span>

/// Bounds of a deformed instance from its pose alone, before any vertex is touched: for culling, and the
/// frame of the packed stream.

namespace goffer::bend {

struct Batch;

/// The box that holds every vertex of `body`, which has one region, at `pose` under `transform` (model space
/// to the box's space), with a margin for rounding of 1e-5 of the body's size. `pose` and `transform` finite;
/// a pose beyond the body's max_angle() is clamped. Conservative: for round bodies at most 1.3 times as long
/// as the tight box on each axis; 1.7 times where folds are deeper than the radius. Some hundred nanoseconds;
/// does not allocate. Thread-safe.
///
/// The body is cut into bands along z; each band's disc, with the largest radius and wrinkle in it, is swept
/// along its piece of the arc.
[[nodiscard]] Bounds bounds(const Body& body, const Pose& pose,
                            const glm::mat4x3& transform = glm::mat4x3(1)) noexcept;

/// The same for a body of several regions: `poses` has one for each.
[[nodiscard]] Bounds bounds(const Body& body, std::span<const Pose> poses,
                            const glm::mat4x3& transform = glm::mat4x3(1)) noexcept;

/// Of a job's current pose and transform. `job.body` not null. The bounds that its packed stream is in.
[[nodiscard]] Bounds bounds(const DeformJob& job) noexcept;

/// Of every instance of `batch`, whatever its masks say: result[i] of instance i. For culling before the
/// masks are known. `result` is the caller's and holds batch.count.
void bounds(const Batch& batch, std::span<Bounds> result, Isa isa = Isa::automatic) noexcept;

/// Of every job: result[i] of jobs[i]. `result` is the caller's and holds as many.
void bounds(std::span<const DeformJob> jobs, std::span<Bounds> result) noexcept;

}  // namespace goffer::bend
