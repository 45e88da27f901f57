// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/job.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

/// Capsules around a deformed instance from its pose alone: for cheap collision.

namespace goffer::bend {

/// The points within `radius` of the line from `from` to `to`.
struct Capsule {
    glm::vec3 from{0};
    glm::vec3 to{0};
    float radius = 0;
};

/// How many capsules a chain has: `pieces` >= 1 for each region of `body`.
[[nodiscard]] inline std::size_t capsule_count(const Body& body, std::size_t pieces) noexcept {
    return body.region_count() * pieces;
}

/// The chain of capsules of `job`'s current pose and transform, base to tip, `pieces` >= 1 for each region,
/// into `result`, which is the caller's and holds capsule_count(). Together they hold every vertex. job.body
/// not null; poses finite and as many as validate() asks for; a pose beyond its region's max_angle() is
/// clamped.
///
/// A capsule's line is the chord of its piece of the center line; its radius is that of the piece's widest
/// vertex, with its deepest wrinkle, and the chord's distance from the arc, times the transform's largest
/// scale: no vertex's distance from the chain is less than its radius by more than wrinkles, detail and that
/// sagitta make up. More pieces fit closer: the sagitta falls with their square. A region without vertices
/// has capsules of radius 0. A tenth of a microsecond for each region and its pieces. Does not allocate.
/// Thread-safe.
void capsules(const DeformJob& job, std::size_t pieces, std::span<Capsule> result) noexcept;

}  // namespace goffer::bend
