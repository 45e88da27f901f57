// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "goffer has to be compiled without -ffast-math and /fp:fast: it rounds on purpose, and looks for NaN"
#endif

/// Directions of any size, taken to -pi..pi: in two steps, of which the second treats many at a time.

namespace goffer::bend {

/// How large a direction wrapped_direction takes, either way.
constexpr float max_wrapped = 4e5f;

/// Takes whole turns off a finite direction that is too large for wrapped_direction.
inline float wrappable_direction(float direction) noexcept {
    if (std::fabs(direction) <= max_wrapped) [[likely]]
        return direction;
    return static_cast<float>(std::remainder(static_cast<double>(direction), 2 * std::numbers::pi));
}

/// Takes directions to -pi..pi. One that is there keeps its bits, and every L gives the same bits: whole
/// turns are subtracted in four parts. Products with the first three, of 8 bits each, are exact, fused or
/// not.
template <class L>
typename L::Vec wrapped_direction(typename L::Vec direction) noexcept {
    using Vec = typename L::Vec;
    constexpr float half_turn = std::numbers::pi_v<float>;
    constexpr float turn[4] = {201.0f / (1 << 5), 254.0f / (1 << 17), -172.0f / (1 << 26), 3.96837e-9f};
    constexpr float to_whole = 1.5f * (1 << 23);  // adding it leaves no binary places
    const Vec half = L::splat(half_turn), minus_half = L::splat(-half_turn), whole = L::splat(2 * half_turn);
    const Vec turns = (direction * L::splat(0.5f / half_turn) + L::splat(to_whole)) - L::splat(to_whole);
    Vec rest = direction;
    for (int part = 0; part < 3; ++part) rest = L::nmadd(turns, L::splat(turn[part]), rest);
    rest = rest - turns * L::splat(turn[3]);
    // Near a half turn, or where the processor rounds up or down, that may be a turn too many or too few.
    rest = L::where_less(half, rest, rest - whole, L::where_less(rest, minus_half, rest + whole, rest));
    return L::where_less(half, L::abs(direction), L::clamp(rest, minus_half, half), direction);
}

}  // namespace goffer::bend
