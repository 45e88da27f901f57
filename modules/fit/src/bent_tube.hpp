// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <goffer/fit/cylinder.hpp>

namespace goffer::fit {

/// Whether a body is a tube that was bent along the rest arcs of `cylinder`, of which there is one or more:
/// as much of it lies on their inner sides as on their outer ones, and none between their ends. The trunk of
/// a tree and one of its branches may look like one where only distances from the arcs are asked for, and so
/// may a disc, about its rim.
[[nodiscard]] bool is_bent_tube(const Body& body, const Cylinder& cylinder);

}  // namespace goffer::fit
