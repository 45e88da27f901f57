// SPDX-License-Identifier: MIT
#pragma once

#include "sections.hpp"

#include <optional>

/// Fits an arc to a body that is bent at rest.

namespace goffer::fit {

/// Returns the arc through the middles of the sections across it, if it is clearly better than `straight`,
/// the best straight line. `axis` (unit length) is roughly the direction from end to end. Returns nothing if
/// the body is not a tube about an arc, or only about one that no body can have: a full turn, or one whose
/// inner side has no length.
///
/// A few arcs are tried on a sample of the surface, which keeps that cheap; the best is then settled on the
/// surface itself.
[[nodiscard]] std::optional<Fitted> fit_arc(const Body& body, const Vector3d& axis, const Line& straight);

}  // namespace goffer::fit
