// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <span>

/// A mesh with more vertices: edges cut, triangles replaced by pieces of themselves, everything else kept.
///
/// What is to be cut comes from elsewhere (fit::refine makes it), as numbers; here all that a mesh and its
/// file carry is interpolated along: normals, tangents, texture coordinates, colors, of glTF also joints and
/// weights, morph targets and attributes of other names.

namespace goffer::mesh {

/// A vertex on an edge of the mesh: at (1 - t) a + t b, 0 < t < 1. Along a seam, where an edge has vertices
/// of its own on either side, both name it in the same direction and with the same t, and get positions of
/// the same bits.
struct EdgeVertex {
    std::uint32_t a = 0, b = 0;  ///< vertices of the mesh
    double t = 0;
};

/// How a mesh with n vertices is cut up. The caller owns the memory.
struct Subdivision {
    std::span<const EdgeVertex> vertices;      ///< vertex n + i
    std::span<const std::uint32_t> triangles;  ///< 3 vertices each
    std::span<const std::uint32_t> parents;    ///< of each triangle: which of triangles(mesh), ascending
};

/// `mesh`, cut up. Faces of which nothing is cut stay what they are, polygons too; the pieces of the others
/// stand in their place, so that parts, groups and materials go on as before. Without new vertices the mesh
/// comes back as it is.
///
/// Vertices keep their places, values and order, and new ones follow: behind all others, but in a glTF
/// scene, which has a vertex array for each of its blocks, behind those of their own array, and in an STL
/// soup, which has none, where their facets stand. Attributes with an index of their own get new values
/// behind the others. Normals and tangents go to unit length where both ends have a direction, else they take
/// after the end that has one; a tangent's side is that of the nearer end.
///
/// The file that the mesh came from is refined along, so that `save` gives back as much of it as it does of
/// a mesh that was bent alone: an OBJ's text, a PLY's elements and properties (whole numbers, which may be
/// names, from the nearer end), an STL's header and attributes, a glTF's whole document. In that, vertex
/// arrays become floats but for joints; indices get 32 bits where 16 are too few; weights are mixed, the
/// largest kept and their sum restored; strips and fans become triangles; a mesh that several nodes show and
/// that is cut in different ways is cloned.
///
/// Throws Error: pieces that are not of this mesh (a number out of range, a triangle none of whose corners
/// lie in its parent, a parent without pieces); a glTF attribute that nothing can be put between (matrices;
/// joints without weights), by its path. Pure; may be called from any thread.
[[nodiscard]] Mesh refined(const Mesh& mesh, const Subdivision& pieces);

}  // namespace goffer::mesh
