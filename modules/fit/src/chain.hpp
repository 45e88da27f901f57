// SPDX-License-Identifier: MIT
#pragma once

#include "sections.hpp"

#include <goffer/fit/cylinder.hpp>

#include <optional>

/// Fits a chain of arcs to a body that is bent at rest, but along no single arc.

namespace goffer::fit {

/// Returns the base of a body along a chain of arcs, if the body is a tube about one, and that clearly better
/// than about `line`, the best arc or straight line. `axis` (unit length), if there is one, decides which end
/// is the base, and must be within about 45 degrees of the chord; without it, the largest component of the
/// direction from base to tip is positive.
[[nodiscard]] std::optional<Cylinder> fit_chain(const Body& body, const Line& line,
                                                const std::optional<Vector3d>& axis);

/// Returns the base of a body along a chain of `arcs`, whether it is clearly better or not. Where fewer
/// follow the body as closely as fit_chain() asks for, and more would not do so clearly better, the longest
/// ones are halved. Where it takes more, they are more: as few as were found. Nothing where the body has no
/// chain, or is not all around it. `axis` as above.
[[nodiscard]] std::optional<Cylinder> fit_chain_of(const Body& body, std::size_t arcs,
                                                   const std::optional<Vector3d>& axis);

}  // namespace goffer::fit
