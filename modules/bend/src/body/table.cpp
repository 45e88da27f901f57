// SPDX-License-Identifier: MIT
#include <goffer/bend/table.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

/// Between rows `low` and `low + 1`.
struct Place {
    std::size_t low;
    float weight;
};

/// `fraction` of the largest angle, in a table of `rows` >= 2.
Place place_of(float fraction, std::size_t rows) noexcept {
    const float last = static_cast<float>(rows - 1);
    const float place = std::sqrt(std::clamp(fraction, 0.0f, 1.0f)) * last;
    const int low = std::min(static_cast<int>(place), static_cast<int>(rows) - 2);
    return {static_cast<std::size_t>(low), place - static_cast<float>(low)};
}

}  // namespace

WrinkleRow WrinkleTable::at(float angle) const noexcept {
    WrinkleRow row{};
    if (rows.empty()) return row;
    const auto [low, weight] = place_of(angle / max_angle, rows.size());
    for (std::size_t n = 0; n < row.size(); ++n) {
        row[n] = rows[low][n] + weight * (rows[low + 1][n] - rows[low][n]);
    }
    return row;
}

float FactorTable::at(float angle, float direction) const noexcept {
    if (rows.empty()) return 1;
    const auto [low, weight] = place_of(angle / max_angle, rows.size());
    constexpr float per_turn = 0.5f * std::numbers::inv_pi_v<float>;
    const float turns = direction * per_turn;
    const float around = (turns - std::floor(turns)) * static_cast<float>(directions);
    const auto j = static_cast<std::size_t>(around) % directions;
    const std::size_t next = (j + 1) % directions;
    const float across = around - std::floor(around);
    const auto along = [&from = rows[low], &to = rows[low + 1], share = weight](std::size_t d) {
        return from[d] + share * (to[d] - from[d]);
    };
    return std::sqrt(std::max(along(j) + across * (along(next) - along(j)), 0.0f));
}

}  // namespace goffer::bend
