// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/method.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// The wrinkle table: one row per bend angle, made at bind, read per frame.
/// See modules/paper/README.md, "Wrinkle table".

namespace goffer::bend {

/// Coefficients of the amplitude profile over the columns, for one bend angle.
///
/// The amplitude of the column at beta is
///     A = sqrt(kappa T) P(T),   T = 1 + cos(beta - theta),   P(T) = sum of row[n] T^n,
/// in model units, with the region's size and the area factor m(alpha) in it. (The squeeze is q = kappa T:
/// its root is the square-root start of eq 7's solution; P is its smooth rest.)
///
/// Where the region is bent at rest, or has an onset q0, the squeeze is relative to the rest arc and
/// begins gently: with S and S_0 the column's scale in the pose and at rest,
///     q = max(0, 1 - S / S_0),   q' = q^2 / (q + q0),   A = S_0 sqrt(q') P(q' / kappa).
/// See modules/paper/README.md, "Bodies bent at rest".
using WrinkleRow = std::array<float, wrinkle_degree + 1>;

/// Rows from angle 0 to `max_angle`, at equal steps of the angle's root: row i of n is for max_angle (i / (n
/// - 1))^2. (The area factor, like the amplitude, is smooth in the root.) A plain value; empty for a body
/// that never wrinkles.
struct WrinkleTable {
    float max_angle = 0;           ///< angle of the last row, radians; > 0 where there are rows
    std::vector<WrinkleRow> rows;  ///< none, or two and more

    [[nodiscard]] bool empty() const noexcept { return rows.empty(); }

    /// The row at `angle`, linear between the two nearest, clamped to the table; zeros where there are no
    /// rows. An angle that is not finite counts as 0. Does not allocate. Thread-safe.
    [[nodiscard]] WrinkleRow at(float angle) const noexcept;
};

/// Factors on the amplitude by angle and direction (mode `mesh`: with them the bound mesh keeps its own
/// area). Rows at angles as those of WrinkleTable; value j of a row is for the direction 2 pi j / directions
/// from that of the region's rest arc, toward e2. Squares of factors, in which area is nearly linear; below
/// 0 where even no wrinkle is too much. A plain value; empty where all factors are 1.
/// See modules/paper/README.md, "Amplitude modes".
struct FactorTable {
    static constexpr std::size_t directions = 16;
    float max_angle = 0;  ///< angle of the last row, radians; > 0 where there are rows
    std::vector<std::array<float, directions>> rows;  ///< none, or two and more

    [[nodiscard]] bool empty() const noexcept { return rows.empty(); }

    /// The factor at `angle` and any `direction`: its square linear between its four neighbors, the angle
    /// clamped to the table's; 1 where there are no rows. What is not finite counts as 0. Does not allocate.
    /// Thread-safe.
    [[nodiscard]] float at(float angle, float direction) const noexcept;
};

}  // namespace goffer::bend
