// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// The operations that kernels are written in, on one float. The other lanes have the same members, on an
/// xsimd batch; this file documents them.

namespace goffer::simd {

struct ScalarLanes {
    using Vec = float;
    static constexpr std::size_t width = 1;

    /// The lanes of a single register, and register `part` of `value`. They differ in DoubledLanes alone.
    using Single = ScalarLanes;
    static Vec single(Vec value, std::size_t /*part*/) { return value; }

    static Vec splat(float value) { return value; }
    static Vec load(const float* from) { return *from; }
    static void store(float* to, Vec value) { *to = value; }
    /// Stores past the cache where the processor can. `to` is aligned to a register. fence() orders the
    /// stores.
    static void stream(float* to, Vec value) { *to = value; }
    /// Asks for the line at `at`, which is about to be written.
    static void prefetch(const float* /*at*/) {}
    /// Stores the first `count` lanes, or all of them if there are fewer.
    static void store_first(float* to, Vec value, std::size_t count) {
        if (count != 0) *to = value;
    }
    /// a b + c, fused where the instruction set has that
    static Vec madd(Vec a, Vec b, Vec c) { return a * b + c; }
    /// c - a b, likewise
    static Vec nmadd(Vec a, Vec b, Vec c) { return c - a * b; }
    static Vec abs(Vec a) { return std::fabs(a); }
    static Vec clamp(Vec a, Vec low, Vec high) { return a < low ? low : a > high ? high : a; }
    /// 1 / sqrt(a) for a > 0, to about the last bit
    static Vec rsqrt(Vec a) { return 1.0f / std::sqrt(a); }
    /// a < b ? yes : no, lane by lane
    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) { return a < b ? yes : no; }
    static Vec max(Vec a, Vec b) { return a > b ? a : b; }
    static Vec min(Vec a, Vec b) { return a < b ? a : b; }
    static Vec sqrt(Vec a) { return std::sqrt(a); }
    /// 1 / a for a > 0, to about the last bit
    static Vec reciprocal(Vec a) { return 1.0f / a; }
    /// `magnitude` >= 0 with the sign of `sign`
    static Vec with_sign(Vec magnitude, Vec sign) { return std::copysign(magnitude, sign); }
    /// The bits of the nearest integer, in a float. Numbers that do not fit, and NaN, give 0x80000000.
    static Vec word(Vec value) { return std::bit_cast<float>(integer(value)); }
    /// The lower halves of two such words in one: that of `low` in the lower half.
    static Vec pack_int16(Vec low, Vec high) {
        return std::bit_cast<float>((integer(low) & 0xffffu) | integer(high) << 16);
    }

    /// Four values of one lane.
    struct Row {
        float values[4];
    };
    /// Calls visit(lane, row) for every lane in order, with the row (a, b, c, d) of that lane.
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        visit(0, Row{{a, b, c, d}});
    }
    /// The row of lane 0.
    static Row first_row(Vec a, Vec b, Vec c, Vec d) { return {{a, b, c, d}}; }
    static void store_row(float* to, const Row& row) { std::memcpy(to, row.values, sizeof row.values); }
    /// Stores the first `count` values, 1 to 4.
    template <std::size_t count>
    static void store_row_first(float* to, const Row& row) {
        std::memcpy(to, row.values, count * sizeof(float));
    }

    /// The row factor (from + weight (to - from)), of four values each.
    static Row mixed_row(const float* from, const float* to, float weight, float factor) {
        Row row;
        for (std::size_t i = 0; i < 4; ++i) row.values[i] = factor * (from[i] + weight * (to[i] - from[i]));
        return row;
    }
    /// The row times four factors, value by value.
    static Row row_times(Row row, const float* factors) {
        for (std::size_t i = 0; i < 4; ++i) row.values[i] *= factors[i];
        return row;
    }

private:
    // In C++ the conversion is undefined where the number does not fit, and for a NaN. This is what x86
    // gives.
    static std::uint32_t integer(Vec value) {
        if (!(std::fabs(value) < 2147483648.0f)) return 0x80000000u;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::nearbyint(value)));
    }
};

}  // namespace goffer::simd
