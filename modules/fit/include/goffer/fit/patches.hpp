// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// What a deformation does to the area of a body here and there: a body that keeps its area as a whole may
/// have one side that shrank and another that grew. Offline: functions may allocate and throw.

namespace goffer::fit {

/// A surface cut into patches about its axis or rest arc: slices of equal height from base to tip, and each
/// of them into sides of equal angle. The middle of side 0 is the zero of beta (e1), and sides go on toward
/// e2.
struct PatchGrid {
    int slices = 12;  ///< 1..2^16, and at most 2^20 patches in all
    int sides = 4;    ///< 1..2^16
};

/// Returns the patch of every triangle, slice * grid.sides + side: the one that the triangle's centroid at
/// rest lies in, in the straightened coordinates of `cylinder`. What lies beyond an end belongs to the slice
/// there. Throws Error as check(geometry) and check(cylinder) do, and if a number of `grid` is out of range.
/// Thread-safe.
[[nodiscard]] std::vector<std::uint32_t> patches_of(const Geometry& geometry, const Cylinder& cylinder,
                                                    const PatchGrid& grid = {});

/// How much the areas of patches change, as fractions: 0.01 is one per cent more than at rest.
struct PatchChange {
    double rms = 0;                 ///< root of the mean square, weighted by the patches' areas at rest
    double worst = 0;               ///< the change that is farthest from 0, with its sign
    std::uint32_t worst_patch = 0;  ///< where that is: slice * grid.sides + side
    std::size_t patches = 0;        ///< how many have an area at rest; the others do not count
};

/// Returns the change of area from `geometry` to the same triangles at `positions`. `patches` is what
/// patches_of() returned for `geometry`. Throws Error if there is not a position for each vertex or a patch
/// for each triangle. Thread-safe.
[[nodiscard]] PatchChange patch_change(const Geometry& geometry, std::span<const glm::vec3> positions,
                                       std::span<const std::uint32_t> patches);

/// Returns, for every vertex, the change of area of the triangles that use it: the mean of their changes, as
/// fractions, weighted by their areas at rest. 0 where these have none. Throws Error if there is not a
/// position for each vertex. Thread-safe.
[[nodiscard]] std::vector<double> vertex_change(const Geometry& geometry,
                                                std::span<const glm::vec3> positions);

}  // namespace goffer::fit
