// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// The wrinkle table: one row per bend angle, made at bind, read per frame.

namespace goffer::bend {

/// Degree of the amplitude profile in T = 1 + cos(beta - theta).
inline constexpr std::size_t wrinkle_degree = 7;

/// Coefficients of the amplitude profile over the columns, for one bend angle.
///
/// The amplitude of the column at beta is
///     A = sqrt(kappa T) P(T),   T = 1 + cos(beta - theta),   P(T) = sum of row[n] T^n,
/// in model units, with the body's size and the area factor m(alpha) in it. (The squeeze is q = kappa T: its
/// root is the square-root start of eq 7's solution; P is its smooth rest.)
using WrinkleRow = std::array<float, wrinkle_degree + 1>;

/// Rows from angle 0 to `max_angle`, at equal steps of the angle's root: row i of n is for max_angle (i / (n
/// - 1))^2. (The area factor, like the amplitude, is smooth in the root.) A plain value; empty for a body
/// that never wrinkles.
struct WrinkleTable {
    float max_angle = 0;           ///< angle of the last row, radians; > 0 where there are rows
    std::vector<WrinkleRow> rows;  ///< none, or two and more

    [[nodiscard]] bool empty() const noexcept { return rows.empty(); }

    /// The row at `angle`, linear between the two nearest, clamped to the table; zeros where there are no
    /// rows. Does not allocate. Thread-safe.
    [[nodiscard]] WrinkleRow at(float angle) const noexcept;
};

}  // namespace goffer::bend
