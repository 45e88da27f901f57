// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// The operations that kernels are written in, on one float. XsimdLanes says the same with an xsimd batch.

namespace goffer::simd {

struct ScalarLanes {
    using Vec = float;
    static constexpr std::size_t width = 1;

    /// The lanes of one register, and register `part` of `value`.
    using Single = ScalarLanes;
    static Vec single(Vec value, std::size_t /*part*/) { return value; }

    static Vec splat(float value) { return value; }
    static Vec load(const float* from) { return *from; }
    static void store(float* to, Vec value) { *to = value; }
    /// Past the cache where the processor can; `to` aligned to the batch. Ordered by the next simd::fence().
    static void stream(float* to, Vec value) { *to = value; }
    /// Asks for the line at `at`, to be written to.
    static void prefetch(const float* /*at*/) {}
    /// The first `count` lanes alone; all of them where there are fewer.
    static void store_first(float* to, Vec value, std::size_t count) {
        if (count != 0) *to = value;
    }
    /// a b + c
    static Vec madd(Vec a, Vec b, Vec c) { return a * b + c; }
    /// c - a b
    static Vec nmadd(Vec a, Vec b, Vec c) { return c - a * b; }
    static Vec abs(Vec a) { return std::fabs(a); }
    static Vec clamp(Vec a, Vec low, Vec high) { return a < low ? low : a > high ? high : a; }
    /// 1 / sqrt(a), a > 0, to about the last bit
    static Vec rsqrt(Vec a) { return 1.0f / std::sqrt(a); }
    /// a < b ? yes : no
    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) { return a < b ? yes : no; }
    static Vec max(Vec a, Vec b) { return a > b ? a : b; }
    static Vec min(Vec a, Vec b) { return a < b ? a : b; }
    static Vec sqrt(Vec a) { return std::sqrt(a); }
    /// 1 / a, a > 0, to about the last bit
    static Vec reciprocal(Vec a) { return 1.0f / a; }
    /// `magnitude`, which is not negative, with the sign of `sign`
    static Vec with_sign(Vec magnitude, Vec sign) { return std::copysign(magnitude, sign); }
    /// The nearest integer's bits, as if they were a float.
    static Vec word(Vec value) { return std::bit_cast<float>(integer(value)); }
    /// The low halves of two such words: `low`'s in the lower half of the result.
    static Vec pair_words(Vec low, Vec high) {
        return std::bit_cast<float>((integer(low) & 0xffffu) | integer(high) << 16);
    }

    /// Four values that belong to one lane.
    struct Row {
        float values[4];
    };
    /// Calls visit(lane, row) for every lane, in order, with the row (a, b, c, d) of that lane.
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        visit(0, Row{{a, b, c, d}});
    }
    /// The row of lane 0.
    static Row first_row(Vec a, Vec b, Vec c, Vec d) { return {{a, b, c, d}}; }
    /// The same without d: what the fourth value is does not matter.
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, const Visit& visit) {
        visit(0, Row{{a, b, c, c}});
    }
    static void store_row(float* to, const Row& row) { std::memcpy(to, row.values, sizeof row.values); }
    /// The first `count` values, 1 to 4.
    template <std::size_t count>
    static void store_row_first(float* to, const Row& row) {
        std::memcpy(to, row.values, count * sizeof(float));
    }

    /// Of four values each: `factor` (from + weight (to - from)).
    static Row mixed_row(const float* from, const float* to, float weight, float factor) {
        Row row;
        for (std::size_t i = 0; i < 4; ++i) row.values[i] = factor * (from[i] + weight * (to[i] - from[i]));
        return row;
    }
    static Row row_times(Row row, const float* factors) {
        for (std::size_t i = 0; i < 4; ++i) row.values[i] *= factors[i];
        return row;
    }

private:
    static std::uint32_t integer(Vec value) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::nearbyint(value)));
    }
};

}  // namespace goffer::simd
