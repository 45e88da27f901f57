// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

/// The base model: the bare cylinder that the method bends and wrinkles, as a mesh.

namespace goffer::paper {

/// Positions in the body frame (base end at the origin, axis along z, the first column on +x) and triangles,
/// three vertex indices each, wound so that their normals point outward.
struct BaseMesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> triangles;
};

/// A grid of columns x rows on the cylinder of `length` and `radius` (model units). `rows` counts the rings
/// of vertices, both ends included; `columns` the vertices of a ring. Ring by ring from z = 0, each in order
/// of beta: vertex (column, row) is number row * columns + column. With `caps` two vertices follow, the
/// centers of base and tip. Throws std::invalid_argument where columns < 3, rows < 2, a size is not positive,
/// or 2^32 vertices don't suffice.
[[nodiscard]] BaseMesh base_mesh(double length, double radius, std::uint32_t columns, std::uint32_t rows,
                                 bool caps = false);

}  // namespace goffer::paper
