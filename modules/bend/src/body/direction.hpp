// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {

/// Takes a finite direction to -pi..pi.
inline float wrapped_direction(float direction) noexcept {
    constexpr float half_turn = std::numbers::pi_v<float>;
    if (std::fabs(direction) <= half_turn) [[likely]]
        return direction;
    constexpr double turn = 2 * std::numbers::pi;
    const double value = static_cast<double>(direction);
    double rest = 0;
    if (std::fabs(direction) < 1e9f) {
        const double turns = value * (1 / turn);
        const auto whole = static_cast<long long>(turns + (turns < 0 ? -0.5 : 0.5));
        rest = (turns - static_cast<double>(whole)) * turn;
    } else {
        rest = std::remainder(value, turn);
    }
    return std::clamp(static_cast<float>(rest), -half_turn, half_turn);
}

}  // namespace goffer::bend
