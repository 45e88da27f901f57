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
/// straight one, less 1. Returns nothing where there is no closed form: for a body that is bent at rest or
/// has an onset, where folds run on over a joint, and where a region has a shape, as all with folds have with
/// Profile::even and Amplitude::mesh. With other profiles Amplitude::mesh counts as Amplitude::paper, since
/// its factors are made for the mesh. Throws Error if there are not as many angles as regions. Thread-safe.
[[nodiscard]] std::optional<double> base_area_change(const Binding& binding, std::span<const double> angles);

/// Returns how far the troughs of region `region`, bent by `angle`, reach inward where the base is squeezed
/// most: model units; 0 without folds. Counts from the straight body and without an onset. Leaves out the
/// factors that depend on the pose, those of Amplitude::area and Amplitude::mesh, but not the weights along
/// the body that Amplitude::mesh has with Profile::even. A wrinkle that is deeper than the radius reaches
/// past the axis. For a region with a shape: the largest depth over the radius where it is, times the base's
/// radius. Thread-safe.
[[nodiscard]] double wrinkle_depth(const Binding& binding, std::size_t region, double angle);

}  // namespace goffer::fit
