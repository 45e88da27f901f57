// SPDX-License-Identifier: MIT
#pragma once

#include "row_scale.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/fit/refine.hpp>

#include <cstdint>

namespace goffer::fit {

/// From one vertex to another.
struct Edge {
    std::uint32_t a, b;
};

/// Cuts edges that span too much of the circumference, where `scale` has folds. `rows`: a refinement of
/// `geometry`, which is cut further; it comes back as it is where columns would be more than
/// options.max_triangles.
[[nodiscard]] Refinement with_columns(const Geometry& geometry, const Cylinder& cylinder,
                                      const RowScale& scale, Refinement rows, const RefineOptions& options);

}  // namespace goffer::fit
