// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Gives a mesh more vertices: edges are cut, triangles are replaced by pieces of themselves, everything else
/// is kept.
///
/// Which edges to cut comes from elsewhere: fit::refine decides it. What is done here is to interpolate all
/// that the mesh and its file carry: normals, tangents, texture coordinates and colors; for glTF also joints
/// and weights, morph targets and attributes of other names.

namespace goffer::mesh {

/// A new vertex on an edge of the mesh or of its pieces, at (1 - t) a + t b, 0 < t < 1. On a seam, where both
/// sides have vertices of their own, edges that are named in the same direction and with the same t get
/// positions of the same bits.
struct EdgeVertex {
    std::uint32_t a = 0, b = 0;  ///< vertices of the mesh, or new ones before this one, of one triangle
    double t = 0;
};

/// How a mesh with n vertices is cut up: what fit::Refinement holds. The caller owns the memory.
struct Subdivision {
    std::span<const EdgeVertex> vertices;      ///< vertices n, n + 1, ...
    std::span<const std::uint32_t> triangles;  ///< 3 vertices each
    std::span<const std::uint32_t> parents;    ///< which of triangles(mesh) each triangle is a piece of,
                                               ///< ascending; every one has a piece or more
};

/// Returns `mesh` cut up by `pieces`. A face of which nothing is cut stays as it is, polygons too; the pieces
/// of another stand in its place, so that parts, groups and materials go on as before, and triangles() of the
/// result are the pieces in their order. Without new vertices the mesh comes back unchanged.
///
/// Vertices keep their values and their order. New ones follow after all others, with two exceptions: in a
/// glTF scene, which has several vertex arrays, after those of their own array; in an STL, which has no
/// shared vertices, where their facets stand. Attributes with an index per corner get new values behind the
/// others. New normals and tangents have unit length; where only one end has a direction, or the two cancel,
/// it is that of the one, or of the nearer end. The sign of a tangent is that of the nearer end.
///
/// The file that the mesh came from is refined with it, so that save() gives back as much of it as of a mesh
/// that was only bent: the text of an OBJ, the elements and properties of a PLY (whole numbers, which may be
/// identifiers, from the nearer end; elements with a row for each face, as some scanners write for texture
/// coordinates, are left out with a warning), the header and attributes of an STL, the whole document of a
/// glTF. There, vertex arrays become floats, but for joints; indices get 32 bits where 16 are too few; the
/// largest weights are kept, with their sum; strips and fans become triangles; a mesh that several nodes show
/// is cloned if it is cut in different ways. A PLY whose types cannot hold the result (integer coordinates,
/// narrow indices, lists in vertices) is not kept: save() writes it anew.
///
/// Throws Error if `pieces` are not of this mesh (a number is out of range, a corner of a piece does not lie
/// in the piece's parent, parents do not ascend or one has no piece), or if a glTF attribute cannot be
/// interpolated (matrices, joints without weights), naming it by its path, or if the result would be beyond
/// `limits`. `progress` is as LoadOptions'. Thread-safe.
[[nodiscard]] Mesh refined(const Mesh& mesh, const Subdivision& pieces, const Limits& limits = {},
                           const std::function<void(double)>& progress = {});

/// The same, cut up as a fit::Refinement says, whose new vertices each have the numbers `a`, `b` and `t`.
template <class Refinement>
requires requires(const Refinement& cuts) {
    { cuts.vertices[0].t } -> std::convertible_to<double>;
}
[[nodiscard]] Mesh refined(const Mesh& mesh, const Refinement& cuts, const Limits& limits = {},
                           const std::function<void(double)>& progress = {}) {
    std::vector<EdgeVertex> vertices;
    vertices.reserve(cuts.vertices.size());
    for (const auto& vertex : cuts.vertices) vertices.push_back({vertex.a, vertex.b, vertex.t});
    return refined(mesh, Subdivision{vertices, cuts.triangles, cuts.parents}, limits, progress);
}

}  // namespace goffer::mesh
