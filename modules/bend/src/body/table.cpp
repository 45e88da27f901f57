// SPDX-License-Identifier: MIT
#include <goffer/bend/table.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

/// A place between two rows.
struct TablePlace {
    std::size_t low, high;
    float weight;
};

/// The place of `angle` in a table of `rows` >= 1. Both may hold anything: an angle that is not finite
/// gives the first row, and one above 0 the last row of a table without a largest angle.
TablePlace place_of(float angle, float max_angle, std::size_t rows) noexcept {
    const float fraction = std::isfinite(angle) ? angle / max_angle : 0.0f;
    const float within = fraction > 0 ? std::min(fraction, 1.0f) : 0.0f;
    const float place = std::sqrt(within) * static_cast<float>(rows - 1);
    const auto before = static_cast<std::size_t>(static_cast<int>(place));
    const std::size_t low = std::min(before, std::max<std::size_t>(rows, 2) - 2);
    return {low, std::min(low + 1, rows - 1), place - static_cast<float>(low)};
}

}  // namespace

WrinkleRow WrinkleTable::at(float angle) const noexcept {
    WrinkleRow row{};
    if (rows.empty()) return row;
    const auto [low, high, weight] = place_of(angle, max_angle, rows.size());
    for (std::size_t n = 0; n < row.size(); ++n) {
        row[n] = rows[low][n] + weight * (rows[high][n] - rows[low][n]);
    }
    return row;
}

float FactorTable::at(float angle, float direction) const noexcept {
    if (rows.empty()) return 1;
    const auto [low, high, weight] = place_of(angle, max_angle, rows.size());
    constexpr float per_turn = 0.5f * std::numbers::inv_pi_v<float>;
    const float turns = std::isfinite(direction) ? direction * per_turn : 0.0f;
    const float around = (turns - std::floor(turns)) * static_cast<float>(directions);
    const auto j = static_cast<std::size_t>(around) % directions;
    const std::size_t next = (j + 1) % directions;
    const float across = around - std::floor(around);
    const auto along = [&from = rows[low], &to = rows[high], share = weight](std::size_t d) {
        return from[d] + share * (to[d] - from[d]);
    };
    return std::sqrt(std::max(along(j) + across * (along(next) - along(j)), 0.0f));
}

}  // namespace goffer::bend
