// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

/// What the offline side of goffer reads of a mesh, whoever owns it: an importer of ours, an engine's asset,
/// a test.

namespace goffer::fit {

/// A mesh as spans. The caller owns the memory; nothing is kept after a call returns.
///
/// All positions are in one space (model space), in any unit. `triangles` holds three vertex indices per
/// triangle. Vertices that no triangle uses are allowed. Several vertices may stand at one place (seams,
/// soups).
struct Geometry {
    std::span<const glm::vec3> positions;      ///< one per vertex
    std::span<const std::uint32_t> triangles;  ///< 3 per triangle, each < positions.size()
    std::span<const glm::vec3> normals = {};   ///< empty, or one per vertex; need not be of unit length
    std::span<const glm::vec4> tangents = {};  ///< empty, or one per vertex; w is the bitangent's sign
};

/// A mesh, an axis or an option that fit cannot use. what() is one line: what is wrong, where, how to mend
/// it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Error naming the first fault: no triangles, an index out of range, a coordinate that is NaN or
/// infinite, an optional stream of another length, all vertices in one point, on one line or in one plane.
/// Pure; may be called from any thread.
void check(const Geometry& geometry);

/// Sum of the triangles' areas, in double. Pure; may be called from any thread.
[[nodiscard]] double surface_area(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> triangles);

}  // namespace goffer::fit
