// SPDX-License-Identifier: MIT
#pragma once

#include <xsimd/xsimd.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

/// Float4 in a register: an xsimd batch of the narrowest instruction set that has one. float4.hpp includes
/// and documents it.

namespace goffer::simd {

struct Mask4 {
#if XSIMD_WITH_SSE2
    using Arch = xsimd::sse2;
#else
    using Arch = xsimd::neon64;
#endif
    xsimd::batch_bool<float, Arch> lanes;
};

struct Float4 {
    using Batch = xsimd::batch<float, Mask4::Arch>;
    static_assert(Batch::size == 4);

    Batch lanes;

    Float4() = default;
    Float4(float a, float b, float c, float d) noexcept : lanes{a, b, c, d} {}
    explicit Float4(Batch batch) noexcept : lanes(batch) {}

    [[nodiscard]] float operator[](std::size_t lane) const noexcept {
        float floats[4];
        lanes.store_unaligned(floats);
        return floats[lane];
    }

    Float4& operator*=(Float4 b) noexcept {
        lanes *= b.lanes;
        return *this;
    }

    friend Float4 operator+(Float4 a, Float4 b) noexcept { return Float4(a.lanes + b.lanes); }
    friend Float4 operator-(Float4 a, Float4 b) noexcept { return Float4(a.lanes - b.lanes); }
    friend Float4 operator*(Float4 a, Float4 b) noexcept { return Float4(a.lanes * b.lanes); }
    friend Float4 operator/(Float4 a, Float4 b) noexcept { return Float4(a.lanes / b.lanes); }
    friend Float4 operator-(Float4 a) noexcept { return Float4(-a.lanes); }
    friend Mask4 operator<(Float4 a, Float4 b) noexcept { return {a.lanes < b.lanes}; }
    friend Mask4 operator>(Float4 a, Float4 b) noexcept { return {a.lanes > b.lanes}; }
};

[[nodiscard]] inline Float4 splat(float value) noexcept {
    return Float4(Float4::Batch(value));
}

[[nodiscard]] inline Float4 load4(const float* from) noexcept {
    return Float4(Float4::Batch::load_unaligned(from));
}

inline void store4(float* to, Float4 a) noexcept {
    a.lanes.store_unaligned(to);
}

/// `yes` where the mask holds, else `no`.
[[nodiscard]] inline Float4 select(Mask4 mask, Float4 yes, Float4 no) noexcept {
    return Float4(xsimd::select(mask.lanes, yes.lanes, no.lanes));
}

/// Whether the mask holds in any lane.
[[nodiscard]] inline bool any(Mask4 mask) noexcept {
    return xsimd::any(mask.lanes);
}

[[nodiscard]] inline Float4 min(Float4 a, Float4 b) noexcept {
    return Float4(xsimd::min(a.lanes, b.lanes));
}

[[nodiscard]] inline Float4 max(Float4 a, Float4 b) noexcept {
    return Float4(xsimd::max(a.lanes, b.lanes));
}

[[nodiscard]] inline Float4 abs(Float4 a) noexcept {
    return Float4(xsimd::abs(a.lanes));
}

[[nodiscard]] inline Float4 sqrt(Float4 a) noexcept {
#if XSIMD_WITH_SSE2
    return Float4(xsimd::sqrt(a.lanes));
#else
    return Float4(Float4::Batch(vsqrtq_f32(a.lanes)));  // xsimd's sqrt is an estimate on Arm
#endif
}

/// (a[1], a[2], a[0], a[3])
[[nodiscard]] inline Float4 rotate_lanes3(Float4 a) noexcept {
#if XSIMD_VERSION_MAJOR >= 13
    return Float4(xsimd::swizzle(a.lanes, xsimd::batch_constant<std::uint32_t, Mask4::Arch, 1, 2, 0, 3>()));
#else
    using Words = xsimd::batch<std::uint32_t, Mask4::Arch>;
    return Float4(xsimd::swizzle(a.lanes, xsimd::batch_constant<Words, 1, 2, 0, 3>()));
#endif
}

/// (a[0], b[0], a[1], b[1])
[[nodiscard]] inline Float4 zip_low(Float4 a, Float4 b) noexcept {
    return Float4(xsimd::zip_lo(a.lanes, b.lanes));
}

/// (a[2], b[2], a[3], b[3])
[[nodiscard]] inline Float4 zip_high(Float4 a, Float4 b) noexcept {
    return Float4(xsimd::zip_hi(a.lanes, b.lanes));
}

}  // namespace goffer::simd
