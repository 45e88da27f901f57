// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>

#if defined(GOFFER_XSIMD)
#include <xsimd/xsimd.hpp>
#endif

// xsimd goes by the flags of the file that includes it. Default flags give SSE2 on x86-64 and NEON on 64-bit
// Arm.
#if defined(GOFFER_XSIMD) && (XSIMD_WITH_SSE2 || XSIMD_WITH_NEON64)
#include <goffer/simd/float4_register.hpp>
#else
#include <goffer/simd/float4_plain.hpp>
#endif

/// Four floats, for bounds, capsules and paths, where the batches of kernels would be too wide. They lie in a
/// register if the default flags of the architecture have one, else in plain floats; both give the same bits.
/// Not for kernel files: the functions have the same names whatever the instruction set, and would be linked
/// for another's.
///
/// A Float4 is made from four floats. a[i] reads a lane; a + b, a - b, a * b, a / b, a *= b and -a work lane
/// by lane; a < b and a > b give a Mask4.

namespace goffer::simd {

/// (from[0], from[1], from[2], 0). Reads three floats only.
[[nodiscard]] inline Float4 load3(const float* from) noexcept {
    return {from[0], from[1], from[2], 0};
}

/// Stores the first `count` lanes, 1 to 4, in pieces of known size: these are stores, not calls of memcpy.
inline void store_first(float* to, Float4 a, std::size_t count) noexcept {
    switch (count) {
        case 4:
            store4(to, a);
            break;
        case 3: {
            std::memcpy(to, &a, 2 * sizeof(float));
            const float third = a[2];
            std::memcpy(to + 2, &third, sizeof third);
            break;
        }
        case 2:
            std::memcpy(to, &a, 2 * sizeof(float));
            break;
        default:
            *to = a[0];
    }
}

/// The sum of coefficients[n] x^n by Horner's scheme, for one value or for four.
template <std::size_t N>
[[nodiscard]] inline float polynomial(const float (&coefficients)[N], float x) noexcept {
    float sum = coefficients[N - 1];
    for (std::size_t n = N - 1; n-- > 0;) sum = sum * x + coefficients[n];
    return sum;
}
template <std::size_t N>
[[nodiscard]] inline Float4 polynomial(const float (&coefficients)[N], Float4 x) noexcept {
    Float4 sum = splat(coefficients[N - 1]);
    for (std::size_t n = N - 1; n-- > 0;) sum = sum * x + splat(coefficients[n]);
    return sum;
}

/// a x b of the first three lanes. The last lane of the result is 0 if those of a and b are finite.
[[nodiscard]] inline Float4 cross(Float4 a, Float4 b) noexcept {
    return rotate_lanes3(a * rotate_lanes3(b) - rotate_lanes3(a) * b);
}

/// The sum of the first three lanes.
[[nodiscard]] inline float sum3(Float4 a) noexcept {
    return a[0] + a[1] + a[2];
}

/// Transposes 4 x 4 floats.
inline void transpose(Float4 (&rows)[4]) noexcept {
    const Float4 low02 = zip_low(rows[0], rows[2]), low13 = zip_low(rows[1], rows[3]);
    const Float4 high02 = zip_high(rows[0], rows[2]), high13 = zip_high(rows[1], rows[3]);
    rows[0] = zip_low(low02, low13);
    rows[1] = zip_high(low02, low13);
    rows[2] = zip_low(high02, high13);
    rows[3] = zip_high(high02, high13);
}

}  // namespace goffer::simd
