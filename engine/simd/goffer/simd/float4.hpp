// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>

#if defined(GOFFER_XSIMD)
#include <xsimd/xsimd.hpp>
#endif

// Xsimd tells what the flags of the file at hand give: everybody's, on x86-64 and on 64-bit Arm, give both of
// these.
#if defined(GOFFER_XSIMD) && (XSIMD_WITH_SSE2 || XSIMD_WITH_NEON64)
#include <goffer/simd/float4_register.hpp>
#else
#include <goffer/simd/float4_plain.hpp>
#endif

/// Four floats: what set-up and output are written in, where the batches of kernels would be too wide. In a
/// register where everybody's flags have one for them, else in plain floats; both give the same bits. Not for
/// kernels' files: these functions have one name for all instruction sets.
///
/// Float4 is made from four floats; it has a[i] to read a lane, a + b, a - b, a * b, a / b, a *= b, -a,
/// and a < b and a > b for a Mask4.

namespace goffer::simd {

/// (from[0], from[1], from[2], 0); reads no more.
[[nodiscard]] inline Float4 load3(const float* from) noexcept {
    return {from[0], from[1], from[2], 0};
}

/// The first `count` of them, 1 to 4. In pieces of known size, which are stores and no calls.
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

/// Horner's scheme for sum of coefficients[n] x^n, of one value or of four.
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

/// a x b of the first three; 0 in the last lane, of finite numbers.
[[nodiscard]] inline Float4 cross(Float4 a, Float4 b) noexcept {
    return turn3(a * turn3(b) - turn3(a) * b);
}

/// The sum of the first three.
[[nodiscard]] inline float sum3(Float4 a) noexcept {
    return a[0] + a[1] + a[2];
}

/// Rows and columns of 4 x 4 floats change places.
inline void transpose(Float4 (&rows)[4]) noexcept {
    const Float4 low02 = zip_low(rows[0], rows[2]), low13 = zip_low(rows[1], rows[3]);
    const Float4 high02 = zip_high(rows[0], rows[2]), high13 = zip_high(rows[1], rows[3]);
    rows[0] = zip_low(low02, low13);
    rows[1] = zip_high(low02, low13);
    rows[2] = zip_low(high02, high13);
    rows[3] = zip_high(high02, high13);
}

}  // namespace goffer::simd
