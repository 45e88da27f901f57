// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

/// Angles, for tests that say them in degrees.

namespace goffer::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double right_angle = pi / 2;
inline constexpr double degree = pi / 180;

}  // namespace goffer::test
