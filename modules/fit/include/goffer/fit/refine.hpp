// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/bind.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Cuts edges that are long along the body's axis, so that a mesh can carry more folds, and edges that are
/// wide about it, so that a fold can follow a body of few sides around. Offline: functions may allocate and
/// throw.
///
/// A fold needs 8 rows of vertices. An edge that reaches over more than one row is cut into pieces of equal
/// height, at most a row each, and every triangle with such an edge into pieces that reach over at most a
/// row. Edges of the result are then cut in half where a wrinkle that is linear along it would be off in
/// its middle by more than 4.4 % of its depth: on the skin, where the edge spans more than 34 degrees. So a
/// body of 11 equal sides or more gets no columns. Neither do edges near the axis, where wrinkles fade, those
/// within 1.3 rows of either end, as of a flat cap, and those in a stretch without folds. Nothing is cut that
/// leads across the gap between two ends of a body that is bent at rest.
///
/// Only the places of its two ends decide where an edge is cut, so that both triangles at it agree, even
/// where vertices are duplicated along a seam: what was closed stays closed, and the surface at rest stays as
/// it was: sides are not rounded. New vertices are floats, whose steps show on a mesh far from the origin. No
/// edge is flipped, and a mesh that has its rows and columns comes back as it is.
///
/// This is not left to a library because meshes here may be soups, have seams and have edges with three
/// triangles: CGAL and OpenMesh take manifolds, and meshoptimizer only simplifies.

namespace goffer::fit {

/// A new vertex on an edge of the mesh or of its pieces, at (1 - t) a + t b, 0 < t < 1. Every attribute is
/// interpolated alike.
/// On a seam, where vertices of both sides stand at one place, both sides name the edge in the same direction
/// and with the same t, to the last bit.
struct EdgeVertex {
    std::uint32_t a = 0, b = 0;  ///< vertices of the mesh, or new ones before this one
    double t = 0;
};

/// How to refine a mesh. The owner of the attributes carries it out: mesh::refined for a mesh::Mesh. The
/// mesh's n vertices keep their numbers.
struct Refinement {
    std::vector<EdgeVertex> vertices;      ///< vertices n, n + 1, ...
    std::vector<std::uint32_t> triangles;  ///< 3 vertices each, wound as the parent is
    std::vector<std::uint32_t> parents;    ///< which triangle of the mesh each triangle is a piece of,
                                           ///< ascending; an uncut one is its own only piece
};

/// A stretch of the body along z with rows at equal distances, 16 for each of its folds. `folds` counts per
/// half length of the stretch, as those of Profile::damped do, and need not be whole. In a stretch without
/// folds nothing is cut.
struct Stretch {
    static constexpr int max_folds = 1 << 20;  ///< far beyond any use, well inside int

    double length = 0;  ///< along z, model units, > 0
    double folds = 0;   ///< 0..max_folds
};

/// Returns the stretches of a body that is to be bound with `options`: its regions with the folds asked for,
/// or else those that suit a region of that length whose mesh is fine enough. Folds are as long as suits the
/// radii of `cylinder`: give it those of fit_shape(), which bind() finds by itself, unless the options have
/// ShapeMode::cylinder. A region with Profile::even on a base with radii is many stretches, each with folds
/// of its own length, and so is one with a wrinkle_range: beyond that there are none. Throws Error where a
/// cylinder has arcs, and the options have regions, but not one for each. Thread-safe.
[[nodiscard]] std::vector<Stretch> stretches_of(const Cylinder& cylinder, const BindOptions& options);

/// Returns how many folds there are in `stretches`, as `profile` counts them: over the whole length of a
/// region if it is even, else over half of it. Thread-safe.
[[nodiscard]] int fold_count(std::span<const Stretch> stretches, Profile profile);

/// Returns how many folds suit each region of a body with that base whose mesh is fine enough, as the profile
/// counts them, whatever number `options` ask for. Errors as stretches_of(). Thread-safe.
[[nodiscard]] std::vector<int> suitable_folds(const Cylinder& cylinder, const BindOptions& options);

/// Thrown where a refined mesh would have more triangles than allowed.
class SizeError : public Error {
public:
    using Error::Error;
};

/// Limits of a refinement, and who hears how far it is.
struct RefineOptions {
    /// Limit for the refined mesh. Rows beyond it are a SizeError; if columns would exceed it, there are
    /// none.
    std::size_t max_triangles = 50'000'000;
    /// Called with the share that is done, from about 0 to nearly 1, ascending, a few hundred times at most,
    /// from the calling thread; it must not throw. Empty: nobody is told.
    std::function<void(double)> progress = {};
};

/// Returns the refinement of `geometry` that gives it a folds_capacity() of at least `folds`, or one less
/// where float rounds its positions by a thousandth of a row, and the columns that these need. Heights and
/// directions are those about `cylinder`'s axis or rest arc. Throws Error as check(geometry) and
/// check(cylinder) do, and if `folds` is out of Stretch's range or the triangles are more than allowed.
/// Thread-safe.
[[nodiscard]] Refinement refine(const Geometry& geometry, const Cylinder& cylinder, int folds,
                                const RefineOptions& options = {});

/// The same for several stretches, from z = 0 upward. What lies below the first or above the last one is
/// refined as if that one went on. Throws Error likewise, and if there is no stretch or one is out of range.
[[nodiscard]] Refinement refine(const Geometry& geometry, const Cylinder& cylinder,
                                std::span<const Stretch> stretches, const RefineOptions& options = {});

/// The same with z given, and without columns: heights[i] is z of vertex i, equal for vertices at one place.
/// Along an edge it is taken to change evenly, as on a straight body. Throws Error as check(geometry) does,
/// and if the heights are not one per vertex or not finite, there is no stretch, one is out of range, or the
/// triangles are more than allowed. Thread-safe.
[[nodiscard]] Refinement refine(const Geometry& geometry, std::span<const double> heights,
                                std::span<const Stretch> stretches, const RefineOptions& options = {});

/// Returns the positions of the refined mesh: `positions`, then those of the new vertices. New vertices at
/// one place on both sides of a seam get the same bits. `refinement` must be of the mesh with these
/// positions. Thread-safe.
[[nodiscard]] std::vector<glm::vec3> refined_positions(std::span<const glm::vec3> positions,
                                                       const Refinement& refinement);

/// Makes the normals of a refined mesh, one per vertex, that shade it as the mesh was shaded before:
/// interpolated over each triangle from its corners, each of which counts the triangles around it within 65
/// degrees (itself alone, where more than 1000 meet). Normals made of the pieces alone would show the flat
/// triangles that they come from. `refinement` must be of the mesh with these positions and triangles, whose
/// indices must be in range; the order is that of refined_positions(). Vertices at one place get their mean,
/// and one without a direction gets (0, 0, 1), as with make_normals(). Thread-safe.
[[nodiscard]] std::vector<glm::vec3> make_refined_normals(std::span<const glm::vec3> positions,
                                                          std::span<const std::uint32_t> triangles,
                                                          const Refinement& refinement);

}  // namespace goffer::fit
