// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/region.hpp>

#include <span>

/// Whether a bent body runs into itself.

namespace goffer::cli {

/// Returns whether parts of a body that are far from each other along it lie deep in each other at `poses`,
/// one per region, and none do at rest. It is judged by the center line and how thick the body is about it,
/// so that parts which touch, or cut into each other by less than about a radius, do not count.
[[nodiscard]] bool runs_through_itself(const bend::Body& body, std::span<const bend::Pose> poses);

}  // namespace goffer::cli
