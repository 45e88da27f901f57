// SPDX-License-Identifier: MIT
#pragma once

#include "sections.hpp"

#include <optional>

/// Fits an arc to a body that is bent at rest.

namespace goffer::fit {

/// The arc through the middles of the sections across it, if it is clearly better than `straight`, the best
/// straight line. `axis` (unit): about where the body's ends lie from each other. Nothing for a body that is
/// no tube about any arc, and for arcs that no body can have: a full turn, or an inner side without length.
///
/// A few arcs are tried on a sample of the surface, so that far bent bodies, where a straight line leaves the
/// body, cost little more; the best is then settled on the surface itself.
[[nodiscard]] std::optional<Fitted> fit_arc(const Body& body, const Vector3d& axis, const Line& straight);

}  // namespace goffer::fit
