// SPDX-License-Identifier: MIT
#pragma once

#include "row_scale.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/fit/refine.hpp>

namespace goffer::fit {

/// Cuts edges that span too much of the circumference, where `scale` has folds. `refinement`: one of
/// `geometry`, which is cut further. Throws SizeError.
[[nodiscard]] Refinement with_columns(const Geometry& geometry, const Cylinder& cylinder,
                                      const RowScale& scale, Refinement refinement,
                                      const RefineOptions& options);

}  // namespace goffer::fit
