// SPDX-License-Identifier: MIT
#include <goffer/bend/table.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::bend {

WrinkleRow WrinkleTable::at(float angle) const noexcept {
    WrinkleRow row{};
    if (rows.empty()) return row;
    const float last = static_cast<float>(rows.size() - 1);
    const float place = std::sqrt(std::clamp(angle / max_angle, 0.0f, 1.0f)) * last;
    const auto low =
        static_cast<std::size_t>(std::min(static_cast<int>(place), static_cast<int>(rows.size()) - 2));
    const float weight = place - static_cast<float>(static_cast<int>(low));
    for (std::size_t n = 0; n < row.size(); ++n) {
        row[n] = rows[low][n] + weight * (rows[low + 1][n] - rows[low][n]);
    }
    return row;
}

}  // namespace goffer::bend
