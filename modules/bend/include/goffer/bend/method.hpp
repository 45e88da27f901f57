// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Constants of the method that more than one module must agree on.

namespace goffer::bend {

/// Degree of the amplitude profile in T = 1 + cos(beta - theta).
inline constexpr std::size_t wrinkle_degree = 7;

/// The amplitude has a corner on the outer line, where cos((beta - theta) / 2) changes sign. While that
/// cosine lies within this of 0, the slopes of both sides are blended.
/// See modules/paper/README.md, "Normals and tangents".
inline constexpr float crease_width = 1e-3f;

}  // namespace goffer::bend
