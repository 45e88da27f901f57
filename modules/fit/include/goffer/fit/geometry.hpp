// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

/// What the offline functions read of a mesh, whoever owns it: goffer's importers, an engine, a test.

namespace goffer::fit {

/// A mesh as spans. The caller owns the memory; no function keeps a span after it returns.
///
/// Positions, normals and tangents are in one space (model space), in any unit. Vertices that no triangle
/// uses are allowed, and so are several vertices at one place (seams, triangle soups).
struct Geometry {
    std::span<const glm::vec3> positions;      ///< one per vertex
    std::span<const std::uint32_t> triangles;  ///< 3 vertex indices each, every one < positions.size()
    std::span<const glm::vec3> normals = {};   ///< empty, or one per vertex, of any length
    std::span<const glm::vec4> tangents = {};  ///< empty, or one per vertex, of any length; the sign of w is
                                               ///< that of the bitangent
    /// Empty, or one per vertex, 0..1: how much a vertex follows the wrinkle that it would have without a
    /// mask, for a face or a label. bind() and bind_level() fold it into the body. Normals follow a mask that
    /// changes along the body; where it changes around it, they are off by up to the angle whose tangent is
    /// the wrinkle's depth over the width of that change.
    std::span<const float> wrinkle_mask = {};
};

/// Thrown for a mesh, an axis or an option that fit cannot use. what() is one line: what is wrong, where, and
/// how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Error naming the first fault: no triangles, indices that are not 3 per triangle or out of range,
/// normals, tangents or a mask that are neither none nor one per vertex, a number that is NaN or infinite, a
/// mask outside 0..1, or triangles whose vertices all lie in one point, on one line or in one plane, as far
/// as float can tell. Thread-safe.
void check(const Geometry& geometry);

/// Returns the sum of the triangles' areas, summed in double. Indices must be in range. Thread-safe.
[[nodiscard]] double surface_area(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> triangles);

}  // namespace goffer::fit
