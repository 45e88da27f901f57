// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

/// Numbers that are refused, and whether others are none of them.

namespace goffer::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

inline bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace goffer::test
