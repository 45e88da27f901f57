// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

/// Four floats in a register of any processor: what set-up and output are written in, where the batches of
/// kernels would be too wide. Compiled with everybody's flags; the compilers' vector extension, no
/// intrinsics.

namespace goffer::simd {

using Four = float __attribute__((vector_size(16)));

[[nodiscard]] inline Four load_four(const float* from) noexcept {
    Four four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

/// (from[0], from[1], from[2], 0); reads no more.
[[nodiscard]] inline Four load_three(const float* from) noexcept {
    return Four{from[0], from[1], from[2], 0};
}

inline void store_four(float* to, Four four) noexcept {
    std::memcpy(to, &four, sizeof four);
}

/// The first `count` of them, 1 to 4. In pieces of known size, which are stores and no calls.
inline void store_first(float* to, Four four, std::size_t count) noexcept {
    switch (count) {
        case 4:
            std::memcpy(to, &four, 16);
            break;
        case 3: {
            std::memcpy(to, &four, 8);
            const float third = four[2];
            std::memcpy(to + 2, &third, 4);
            break;
        }
        case 2:
            std::memcpy(to, &four, 8);
            break;
        default:
            *to = four[0];
    }
}

[[nodiscard]] inline Four all(float value) noexcept {
    return Four{value, value, value, value};
}

/// Horner's scheme for sum of coefficients[n] x^n, of one value or of four.
template <std::size_t N>
[[nodiscard]] inline float polynomial(const float (&coefficients)[N], float x) noexcept {
    float sum = coefficients[N - 1];
    for (std::size_t n = N - 1; n-- > 0;) sum = sum * x + coefficients[n];
    return sum;
}
template <std::size_t N>
[[nodiscard]] inline Four polynomial(const float (&coefficients)[N], Four x) noexcept {
    Four sum = all(coefficients[N - 1]);
    for (std::size_t n = N - 1; n-- > 0;) sum = sum * x + all(coefficients[n]);
    return sum;
}

[[nodiscard]] inline Four smaller(Four a, Four b) noexcept {
    return a < b ? a : b;
}

[[nodiscard]] inline Four larger(Four a, Four b) noexcept {
    return a > b ? a : b;
}

[[nodiscard]] inline Four absolute(Four a) noexcept {
    return a < 0 ? -a : a;
}

[[nodiscard]] inline Four root(Four a) noexcept {
    return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

/// a x b of the first three.
[[nodiscard]] inline Four cross(Four a, Four b) noexcept {
    const Four a_next = __builtin_shufflevector(a, a, 1, 2, 0, 3);
    const Four b_next = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const Four turned = a * b_next - a_next * b;
    return __builtin_shufflevector(turned, turned, 1, 2, 0, 3);
}

/// The sum of the first three.
[[nodiscard]] inline float sum_three(Four a) noexcept {
    return a[0] + a[1] + a[2];
}

/// Rows and columns of 4 x 4 floats change places.
inline void transpose(Four (&rows)[4]) noexcept {
    const Four low02 = __builtin_shufflevector(rows[0], rows[2], 0, 4, 1, 5);
    const Four low13 = __builtin_shufflevector(rows[1], rows[3], 0, 4, 1, 5);
    const Four high02 = __builtin_shufflevector(rows[0], rows[2], 2, 6, 3, 7);
    const Four high13 = __builtin_shufflevector(rows[1], rows[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(low02, low13, 0, 4, 1, 5);
    rows[1] = __builtin_shufflevector(low02, low13, 2, 6, 3, 7);
    rows[2] = __builtin_shufflevector(high02, high13, 0, 4, 1, 5);
    rows[3] = __builtin_shufflevector(high02, high13, 2, 6, 3, 7);
}

}  // namespace goffer::simd
