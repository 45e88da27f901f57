// SPDX-License-Identifier: MIT
#include <goffer/bend/table.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::bend {

WrinkleRow WrinkleTable::at(double angle) const noexcept {
    WrinkleRow row{};
    if (rows.empty()) return row;
    const double last = static_cast<double>(rows.size() - 1);
    const double part = std::clamp(angle / static_cast<double>(max_angle), 0.0, 1.0);
    const double place = std::sqrt(part) * last;
    const std::size_t low = std::min(static_cast<std::size_t>(place), rows.size() - 2);
    const float weight = static_cast<float>(place - static_cast<double>(low));
    for (std::size_t n = 0; n < row.size(); ++n) {
        row[n] = rows[low][n] + weight * (rows[low + 1][n] - rows[low][n]);
    }
    return row;
}

}  // namespace goffer::bend
