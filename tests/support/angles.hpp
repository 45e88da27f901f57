// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>

/// Angles, for tests that say them in degrees.

namespace goffer::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double right_angle = pi / 2;
inline constexpr double degree = pi / 180;

/// In degrees, right for small angles; 180 where one of them has no direction.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    if (!(glm::dot(a, a) > 0 && glm::dot(b, b) > 0)) return 180;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

}  // namespace goffer::test
