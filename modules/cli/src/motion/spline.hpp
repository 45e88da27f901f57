// SPDX-License-Identifier: MIT
#pragma once

#include "motion/path.hpp"

#include <glm/vec3.hpp>

#include <vector>

namespace goffer::cli {

/// The points of a polyline that stands for a path: its own where it is straight from point to point; else
/// points on its Bezier curves, or on a centripetal Catmull-Rom curve through its points, so many that
/// neighbors differ little in direction. A closed curve through points ends with its first; of other closed
/// paths the last point is as it is said, and the way back to the first is left to the caller.
[[nodiscard]] std::vector<glm::dvec3> sampled(const PathWords& words);

}  // namespace goffer::cli
