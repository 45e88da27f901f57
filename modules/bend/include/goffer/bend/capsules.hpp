// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/job.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

/// Capsules around a deformed instance, from its pose alone: for cheap collision.

namespace goffer::bend {

/// The points within `radius` of the segment between `from` and `to`. In the space of the job's outputs.
struct Capsule {
    glm::vec3 from{0};
    glm::vec3 to{0};
    float radius = 0;
};

/// The number of capsules in a chain with `pieces` >= 1 for each region of `body`. Thread-safe.
[[nodiscard]] inline std::size_t capsule_count(const Body& body, std::size_t pieces) noexcept {
    return body.region_count() * pieces;
}

/// Writes the chain of capsules at `job`'s current poses, transform and wrinkle_weight, from base to tip,
/// `pieces` >= 1 for each region. Together they hold every vertex; with a table of the caller's own, as far
/// as bounds() does. `result` is the caller's and holds capsule_count() or more. job.body is neither null nor
/// empty; outputs are not read. Poses may hold any bits: an angle beyond its region's max_angle is clamped,
/// and poses that are not finite are taken as at rest.
///
/// A capsule's segment is the chord of its piece of the center line. Its radius is the sum of three lengths,
/// times an upper bound of the transform's largest scale, which is exact for rotations and uniform scales:
/// the largest distance of a vertex from the axis there, the deepest wrinkle there, and the chord's distance
/// from the arc (the sagitta); and a margin for rounding: 1e-5 of these, 1e-6 of the region's length and of
/// the coordinates of its middle and, for bodies with a shape, the error of the stored drift. "There" are the
/// elevenths of the region, from its lowest vertex to its highest one, that the piece lies in, and the next
/// ones: more pieces than eleven shrink the sagitta alone, which falls with their square. A region without
/// vertices has capsules of radius 0. Does not allocate. Thread-safe.
void capsules(const DeformJob& job, std::size_t pieces, std::span<Capsule> result) noexcept;

}  // namespace goffer::bend
