// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Constants of the method that several modules must agree on.

namespace goffer::bend {

/// Degree of the amplitude's polynomial in T = 1 + cos(beta - theta): see WrinkleRow.
inline constexpr std::size_t wrinkle_degree = 7;

/// The amplitude has a corner on the outer line, where cos((beta - theta) / 2) changes sign. Where the
/// absolute value of that cosine is below crease_width, the slopes of both sides are blended.
/// See modules/paper/README.md, "Normals and tangents".
inline constexpr float crease_width = 1e-3f;

}  // namespace goffer::bend
