// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

/// Values between keys.

namespace goffer::cli {

/// How a motion goes from key to key: at an even pace (linear), or without a jump in its speed (smooth).
enum class Interpolation : std::uint8_t { linear, smooth };

/// The moment within 0..`length` at which a motion of that length is after `seconds`.
[[nodiscard]] inline double within(double seconds, double length, bool repeats) {
    if (!repeats) return std::clamp(seconds, 0.0, length);
    const double rest = std::fmod(seconds, length);
    return rest < 0 ? rest + length : rest;
}

/// Where a time lies: `share`, 0..1, of the way from key `key` to the next; 0 exactly at a key.
struct KeyPlace {
    std::size_t key = 0;
    double share = 0;
};

/// `times` ascend. Before the first and after the last: at that one.
[[nodiscard]] inline KeyPlace place_among(std::span<const double> times, double time) {
    const auto after = std::ranges::upper_bound(times, time);
    if (after == times.begin()) return {};
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (key + 1 == times.size()) return {key, 0};
    return {key, (time - times[key]) / (times[key + 1] - times[key])};
}

[[nodiscard]] inline double product(double a, double b) {
    return a * b;
}
template <class Vector>
[[nodiscard]] double product(const Vector& a, const Vector& b) {
    return glm::dot(a, b);
}

/// The speed at a key between two stretches, of `before` and `after` seconds, in which the speed is `in` and
/// `out`: that of the parabola through three keys, but none where the motion turns back, and at most three
/// times the lesser of the two. Along a line a cubic with such slopes does not overshoot (Fritsch and Carlson
/// 1980); a vector's does so in every direction alike.
template <class Value>
[[nodiscard]] Value speed_at_key(double before, double after, const Value& in, const Value& out) {
    if (product(in, out) <= 0) return Value(0);
    const Value speed = (after * in + before * out) / (before + after);
    const double most = 3 * std::sqrt(std::min(product(in, in), product(out, out)));
    const double fast = std::sqrt(product(speed, speed));
    return fast > most ? speed * (most / fast) : speed;
}

/// The value at `place`, of a number or a GLM vector of doubles; `value(i)` is that of key i. Smooth: a cubic
/// for each stretch, whose speed at keys is speed_at_key(); at the first and the last it is 0 or, where the
/// motion `repeats`, that of a motion that goes on from the last as from the first.
template <class ValueOf>
[[nodiscard]] auto interpolated(Interpolation how, std::span<const double> times, bool repeats,
                                const KeyPlace& place, ValueOf value) {
    using Value = decltype(value(std::size_t{0}));
    const std::size_t key = place.key, last = times.size() - 1;
    const double u = place.share;
    const Value from = value(key);
    if (u == 0) return from;
    const Value to = value(key + 1);
    if (how == Interpolation::linear) return Value(from + u * (to - from));
    const auto stretch = [&](std::size_t first) { return times[first + 1] - times[first]; };
    const auto speed = [&](std::size_t first) {
        return Value((value(first + 1) - value(first)) / stretch(first));
    };
    const auto slope = [&](std::size_t at) {
        const bool end = at == 0 || at == last;
        if (end && !repeats) return Value(0);
        const std::size_t before = at == 0 ? last - 1 : at - 1, after = at == last ? 0 : at;
        return speed_at_key(stretch(before), stretch(after), speed(before), speed(after));
    };
    const double step = stretch(key), v = 1 - u;
    return Value((1 + 2 * u) * v * v * from + u * u * (3 - 2 * u) * to +
                 step * u * v * (v * slope(key) - u * slope(key + 1)));
}

}  // namespace goffer::cli
