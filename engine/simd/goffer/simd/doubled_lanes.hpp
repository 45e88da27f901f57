// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace goffer::simd {

/// Two batches of `Lanes` as one: a constant is loaded once for both, and each runs while the other waits for
/// its operands. Members as in ScalarLanes.
template <class Lanes>
struct DoubledLanes {
    struct Vec {
        typename Lanes::Vec low, high;

        friend Vec operator+(Vec a, Vec b) { return {a.low + b.low, a.high + b.high}; }
        friend Vec operator-(Vec a, Vec b) { return {a.low - b.low, a.high - b.high}; }
        friend Vec operator*(Vec a, Vec b) { return {a.low * b.low, a.high * b.high}; }
    };
    static constexpr std::size_t half = Lanes::width;
    static constexpr std::size_t width = 2 * half;
    using Single = Lanes;
    static typename Lanes::Vec single(Vec value, std::size_t part) {
        return part == 0 ? value.low : value.high;
    }

    static Vec splat(float value) {
        const typename Lanes::Vec both = Lanes::splat(value);
        return {both, both};
    }
    static Vec load(const float* from) { return {Lanes::load(from), Lanes::load(from + half)}; }
    static void store(float* to, Vec value) {
        Lanes::store(to, value.low);
        Lanes::store(to + half, value.high);
    }
    static void stream(float* to, Vec value) {
        Lanes::stream(to, value.low);
        Lanes::stream(to + half, value.high);
    }
    static void store_first(float* to, Vec value, std::size_t count) {
        Lanes::store_first(to, value.low, count < half ? count : half);
        Lanes::store_first(to + half, value.high, count < half ? 0 : count - half);
    }
    static Vec madd(Vec a, Vec b, Vec c) {
        return {Lanes::madd(a.low, b.low, c.low), Lanes::madd(a.high, b.high, c.high)};
    }
    static Vec nmadd(Vec a, Vec b, Vec c) {
        return {Lanes::nmadd(a.low, b.low, c.low), Lanes::nmadd(a.high, b.high, c.high)};
    }
    static Vec abs(Vec a) { return {Lanes::abs(a.low), Lanes::abs(a.high)}; }
    static Vec clamp(Vec a, Vec low, Vec high) {
        return {Lanes::clamp(a.low, low.low, high.low), Lanes::clamp(a.high, low.high, high.high)};
    }
    static Vec rsqrt(Vec a) { return {Lanes::rsqrt(a.low), Lanes::rsqrt(a.high)}; }
    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) {
        return {Lanes::where_less(a.low, b.low, yes.low, no.low),
                Lanes::where_less(a.high, b.high, yes.high, no.high)};
    }
    static Vec max(Vec a, Vec b) { return {Lanes::max(a.low, b.low), Lanes::max(a.high, b.high)}; }
    static Vec reciprocal(Vec a) { return {Lanes::reciprocal(a.low), Lanes::reciprocal(a.high)}; }
    static Vec with_sign(Vec magnitude, Vec sign) {
        return {Lanes::with_sign(magnitude.low, sign.low), Lanes::with_sign(magnitude.high, sign.high)};
    }
    static Vec word(Vec value) { return {Lanes::word(value.low), Lanes::word(value.high)}; }
    static Vec pack_int16(Vec low, Vec high) {
        return {Lanes::pack_int16(low.low, high.low), Lanes::pack_int16(low.high, high.high)};
    }
};

}  // namespace goffer::simd
