// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {

/// Takes a finite direction to -pi..pi. One that is there keeps its bits. Without a branch on that, which
/// processors would often guess wrong.
inline float wrapped_direction(float direction) noexcept {
    constexpr float half_turn = std::numbers::pi_v<float>;
    constexpr double turn = 2 * std::numbers::pi;
    const double value = static_cast<double>(direction);
    double rest = 0;
    if (std::fabs(direction) < 1e9f) [[likely]] {
        constexpr double half = 0.5 - 1.5e-8;  // so that half_turn, which is above pi, stays as it is
        const double turns = value * (1 / turn);
        const auto whole = static_cast<long long>(turns + std::copysign(half, turns));
        rest = (turns - static_cast<double>(whole)) * turn;
    } else {
        rest = std::remainder(value, turn);
    }
    return std::min(std::max(static_cast<float>(rest), -half_turn), half_turn);
}

}  // namespace goffer::bend
