// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Splits edges that are long along the body's axis, so that a mesh can carry more folds (offline; may
/// allocate, may throw).
///
/// A fold needs 8 rows of vertices. An edge that reaches over more than one row is cut into equal pieces of
/// at most a row each, and every triangle that has such an edge into pieces that reach over at most a row,
/// in one pass. Only the two ends' places decide where an edge is cut, so both triangles at it agree, also
/// where vertices are duplicated along a seam: what was closed stays closed, and the bare surface stays as it
/// was. Nothing is cut round the circumference, nothing is flipped, and a mesh that has its rows comes back
/// as it is.
///
/// A module of its own, because what Debian packages does something else: CGAL remeshes (GPL; manifolds, no
/// attributes), OpenMesh's subdividers take manifolds and know no seams, meshoptimizer only simplifies. Here
/// meshes are soups, have seams and edges with three triangles, and keep every attribute.

namespace goffer::fit {

/// A vertex on the line between two of the mesh: at (1 - t) a + t b, 0 < t < 1. Every attribute goes the same
/// way. Where several stand at one place, on the two sides of a seam, their a's do too, and so their b's; t
/// is the same to the last bit.
struct EdgeVertex {
    std::uint32_t a = 0, b = 0;  ///< vertices of the mesh before; b is the higher one
    double t = 0;
};

/// How to refine a mesh: a recipe that whoever owns the attributes carries out. Vertices of the mesh keep
/// their numbers.
struct Refinement {
    std::vector<EdgeVertex> vertices;      ///< vertex n + i, where the mesh had n before
    std::vector<std::uint32_t> triangles;  ///< 3 vertices each; turned as the parent is
    std::vector<std::uint32_t> parents;  ///< of each triangle, ascending; an uncut one is its own only piece
};

/// A stretch of a body's length whose rows lie equally far apart: 16 to a fold, as `folds` counts per half
/// length of the stretch. Without folds nothing is cut in it.
struct Stretch {
    double length = 0;  ///< along z, in model units, > 0
    int folds = 0;      ///< 0..2^20
};

/// Bounds on what may come of it.
struct RefineOptions {
    std::size_t most_triangles = 50'000'000;
};

/// The refinement of `geometry` after which folds_capacity(geometry, cylinder) is at least `folds`. (Where
/// positions are so far from the origin that floats round them by a thousandth of a row, one less can come
/// of it.) Heights are those along `cylinder`'s axis or rest arc. Throws Error: what check(geometry) and
/// check(cylinder) throw; folds out of range; more triangles than allowed. Pure; may be called from any
/// thread. About 40 ms per 100,000 triangles that come of it.
[[nodiscard]] Refinement refine(const Geometry& geometry, const Cylinder& cylinder, int folds,
                                const RefineOptions& options = {});

/// The same for a body of several stretches, from z = 0 upward; what lies below or above all of them counts
/// to the first or last. Throws Error: the same; no stretches, or one out of range.
[[nodiscard]] Refinement refine(const Geometry& geometry, const Cylinder& cylinder,
                                std::span<const Stretch> stretches, const RefineOptions& options = {});

/// The same with heights given: `heights` holds z of each vertex, the same for vertices at one place; along
/// an edge it is taken to grow evenly, as on a straight body. Throws Error: what check(geometry) throws; no
/// stretches, or one out of range; another number of heights than vertices, or one that is not finite; more
/// triangles than allowed. Pure; may be called from any thread.
[[nodiscard]] Refinement refine(const Geometry& geometry, std::span<const double> heights,
                                std::span<const Stretch> stretches, const RefineOptions& options = {});

/// The positions of the refined mesh: those of the mesh, then the new ones. Vertices of `refinement` at one
/// place on both sides of a seam get the same bits. `refinement` belongs to these positions. Pure; may be
/// called from any thread.
[[nodiscard]] std::vector<glm::vec3> refined_positions(std::span<const glm::vec3> positions,
                                                       const Refinement& refinement);

}  // namespace goffer::fit
