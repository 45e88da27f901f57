// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

/// The base model: the bare cylinder that the method bends and wrinkles, as a mesh. In double.

namespace goffer::paper {

/// Positions are in the body frame: base end at the origin, axis along z, first column at beta = 0, on +x.
struct BaseMesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> triangles;  ///< 3 vertex indices each; normals point outward
};

/// Makes a grid on the cylinder of `length` and `radius` (model units). `rows` counts the rings of vertices,
/// both ends included; `columns` counts the vertices of a ring. Vertices go ring by ring from z = 0, each
/// ring in order of beta: vertex (column, row) is number row * columns + column. With `caps` two vertices
/// follow, the centers of base and tip, and the triangles that close the ends.
///
/// Throws std::invalid_argument if columns < 3, rows < 2, length or radius is not a finite number above 0, or
/// the vertices are too many for 32-bit indices. Thread-safe.
[[nodiscard]] BaseMesh base_mesh(double length, double radius, std::uint32_t columns, std::uint32_t rows,
                                 bool caps = false);

}  // namespace goffer::paper
