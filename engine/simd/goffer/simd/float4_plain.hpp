// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

/// Float4 in plain floats, for builds without xsimd and for processors on which xsimd has no register of
/// four. float4.hpp includes and documents it.

namespace goffer::simd {

struct Mask4 {
    bool lanes[4];
};

struct Float4 {
    float lanes[4];

    Float4() = default;
    constexpr Float4(float a, float b, float c, float d) noexcept : lanes{a, b, c, d} {}

    [[nodiscard]] float operator[](std::size_t lane) const noexcept { return lanes[lane]; }

    Float4& operator*=(Float4 b) noexcept { return *this = *this * b; }

    friend Float4 operator+(Float4 a, Float4 b) noexcept {
        return each(a, b, [](float x, float y) { return x + y; });
    }
    friend Float4 operator-(Float4 a, Float4 b) noexcept {
        return each(a, b, [](float x, float y) { return x - y; });
    }
    friend Float4 operator*(Float4 a, Float4 b) noexcept {
        return each(a, b, [](float x, float y) { return x * y; });
    }
    friend Float4 operator/(Float4 a, Float4 b) noexcept {
        return each(a, b, [](float x, float y) { return x / y; });
    }
    friend Float4 operator-(Float4 a) noexcept { return {-a[0], -a[1], -a[2], -a[3]}; }
    friend Mask4 operator<(Float4 a, Float4 b) noexcept {
        return {{a[0] < b[0], a[1] < b[1], a[2] < b[2], a[3] < b[3]}};
    }
    friend Mask4 operator>(Float4 a, Float4 b) noexcept { return b < a; }

    /// f(a, b), lane by lane.
    template <class F>
    [[nodiscard]] static Float4 each(Float4 a, Float4 b, F f) noexcept {
        return {f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])};
    }
};

[[nodiscard]] inline Float4 splat(float value) noexcept {
    return {value, value, value, value};
}

[[nodiscard]] inline Float4 load4(const float* from) noexcept {
    return {from[0], from[1], from[2], from[3]};
}

inline void store4(float* to, Float4 a) noexcept {
    for (std::size_t i = 0; i < 4; ++i) to[i] = a[i];
}

/// `yes` where the mask holds, else `no`.
[[nodiscard]] inline Float4 select(Mask4 mask, Float4 yes, Float4 no) noexcept {
    Float4 result;
    for (std::size_t i = 0; i < 4; ++i) result.lanes[i] = mask.lanes[i] ? yes[i] : no[i];
    return result;
}

/// Whether the mask holds in any lane.
[[nodiscard]] inline bool any(Mask4 mask) noexcept {
    return mask.lanes[0] || mask.lanes[1] || mask.lanes[2] || mask.lanes[3];
}

[[nodiscard]] inline Float4 min(Float4 a, Float4 b) noexcept {
    return Float4::each(a, b, [](float x, float y) { return x < y ? x : y; });
}

[[nodiscard]] inline Float4 max(Float4 a, Float4 b) noexcept {
    return Float4::each(a, b, [](float x, float y) { return x > y ? x : y; });
}

[[nodiscard]] inline Float4 abs(Float4 a) noexcept {
    return {std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2]), std::fabs(a[3])};
}

[[nodiscard]] inline Float4 sqrt(Float4 a) noexcept {
    return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

/// (a[1], a[2], a[0], a[3])
[[nodiscard]] inline Float4 rotate_lanes3(Float4 a) noexcept {
    return {a[1], a[2], a[0], a[3]};
}

/// (a[0], b[0], a[1], b[1])
[[nodiscard]] inline Float4 zip_low(Float4 a, Float4 b) noexcept {
    return {a[0], b[0], a[1], b[1]};
}

/// (a[2], b[2], a[3], b[3])
[[nodiscard]] inline Float4 zip_high(Float4 a, Float4 b) noexcept {
    return {a[2], b[2], a[3], b[3]};
}

}  // namespace goffer::simd
