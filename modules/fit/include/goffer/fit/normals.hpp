// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// Normals for meshes that have none.

namespace goffer::fit {

/// Unit normals, one per vertex: angle-weighted over the triangles that meet at the vertex's place, so that
/// duplicated vertices agree; where they cancel (two sheets back to back), over the vertex's own. A vertex
/// without a direction (no triangles, or none with an area) gets (0, 0, 1). Indices as `check` accepts them.
/// Pure; may be called from any thread.
[[nodiscard]] std::vector<glm::vec3> make_normals(std::span<const glm::vec3> positions,
                                                  std::span<const std::uint32_t> triangles);

}  // namespace goffer::fit
