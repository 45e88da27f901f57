// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/method.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// The tables of a region, with a row per bend angle: made at bind, read once per instance and frame.
/// See modules/paper/README.md, "Wrinkle table".

namespace goffer::bend {

/// Coefficients of the wrinkles' amplitude over the columns, for one bend angle.
///
/// The column at beta has the amplitude, in model units,
///
///     A = sqrt(kappa T) P(T),   T = 1 + cos(beta - theta),   P(T) = sum of row[n] T^n.
///
/// The row includes the region's length and the area factor m(alpha). The squeeze is q = kappa T; the
/// solution of eq 7 begins like its root, and P is the smooth factor that remains.
///
/// Where the region is bent at rest, or has an onset q0, the squeeze is relative to the rest arc. With S and
/// S_0 the column's scale in the pose and at rest,
///
///     q = max(0, 1 - S / S_0),   q' = q^2 / (q + q0),   A = S_0 sqrt(q') P(q' / kappa).
///
/// In a region with a shape, s T stands for T in all of this, with s = RestVertex::scale, and kappa is that
/// of the region's mean radius. The polynomial must hold for s T from 0 to 2 max_scale.
///
/// See modules/paper/README.md, "Bodies bent at rest" and "Shaped bodies".
using WrinkleRow = std::array<float, wrinkle_degree + 1>;

/// Rows from angle 0 to `max_angle`, at equal steps of the angle's root, in which the area factor is smooth:
/// row i of n is for the angle max_angle (i / (n - 1))^2. A plain value. Empty: the region never wrinkles.
struct WrinkleTable {
    /// The most rows of this table, and of a FactorTable, that a body file holds, and that the fit makes.
    /// Body::make takes more.
    static constexpr int max_rows = 4096;

    float max_angle = 0;           ///< angle of the last row, radians; > 0 where there are rows
    std::vector<WrinkleRow> rows;  ///< none, or at least two

    [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
    /// Whether they do the same: without rows the angle means nothing.
    [[nodiscard]] bool operator==(const WrinkleTable& other) const noexcept {
        return rows == other.rows && (empty() || max_angle == other.max_angle);
    }

    /// The row at `angle` in radians, interpolated linearly over the angle's root between the two nearest
    /// rows. Angles outside 0..max_angle count as the nearer end, and those that are not finite as 0. Zeros
    /// where there are no rows. Does not allocate. Thread-safe.
    [[nodiscard]] WrinkleRow at(float angle) const noexcept;
};

/// Factors on the amplitude by angle and direction, with which the bound mesh keeps its own area (amplitude
/// mode `mesh`). Rows stand at the same angles as those of a WrinkleTable. Value j of a row is for the
/// direction 2 pi j / directions, counted from the direction of the region's rest arc, toward e2. The values
/// are squares of factors, in which area is nearly linear; where they, interpolated, are negative, the factor
/// is 0. A plain value. Empty: all factors are 1. See modules/paper/README.md, "Amplitude modes".
struct FactorTable {
    static constexpr std::size_t directions = 16;  ///< values in a row

    float max_angle = 0;  ///< angle of the last row, radians; > 0 where there are rows
    std::vector<std::array<float, directions>> rows;  ///< none, or at least two

    [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
    /// As of a WrinkleTable.
    [[nodiscard]] bool operator==(const FactorTable& other) const noexcept {
        return rows == other.rows && (empty() || max_angle == other.max_angle);
    }

    /// The factor at `angle`, and at `direction` from the rest arc's, both in radians. Its square is
    /// interpolated linearly over the direction and over the angle's root. Angles outside 0..max_angle count
    /// as the nearer end; numbers that are not finite count as 0. 1 where there are no rows. Does not
    /// allocate. Thread-safe.
    [[nodiscard]] float at(float angle, float direction) const noexcept;
};

}  // namespace goffer::bend
