// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// Normals for meshes that have none.

namespace goffer::fit {

/// Makes unit normals, one per vertex, on the side from which triangles appear counterclockwise: the mean of
/// the triangles that meet at the vertex's place, weighted by their angles there, so that vertices at one
/// place agree. Where these cancel, as with two sheets back to back, a vertex gets the mean of its own
/// triangles. A vertex without a direction (no triangle, or none with an area) gets (0, 0, 1). Indices must
/// be in range. Thread-safe.
[[nodiscard]] std::vector<glm::vec3> make_normals(std::span<const glm::vec3> positions,
                                                  std::span<const std::uint32_t> triangles);

}  // namespace goffer::fit
