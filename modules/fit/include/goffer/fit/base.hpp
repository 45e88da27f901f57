// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/bind.hpp>

#include <cstddef>
#include <optional>
#include <span>

/// What bending does to the base cylinder of a bound body, in the paper's closed form. Angles are radians, at
/// most the body's largest; their signs do not matter.

namespace goffer::fit {

/// Returns the lateral area of the base, bent by `angles` (one per region) and wrinkled, over that of the
/// straight one, less 1. Returns nothing for a body that is bent at rest or has an onset, whose base has no
/// closed form. Amplitude::mesh counts as Amplitude::paper, since its factors are made for the mesh. Throws
/// Error if there are not as many angles as regions. Thread-safe.
[[nodiscard]] std::optional<double> base_area_change(const Binding& binding, std::span<const double> angles);

/// Returns the depth of the wrinkle of region `region`, bent by `angle`, where the base is squeezed most:
/// model units; 0 without folds. Leaves out the factors of Amplitude::area and Amplitude::mesh. A wrinkle
/// that is deeper than the radius reaches past the axis. For a region with a shape: the largest depth over
/// the radius where it is, times the base's radius. Thread-safe.
[[nodiscard]] double wrinkle_depth(const Binding& binding, std::size_t region, double angle);

}  // namespace goffer::fit
