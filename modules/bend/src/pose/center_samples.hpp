// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/simd/float4.hpp>

#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>

/// Where the center line of a bent region runs, to compare it with a path.

namespace goffer::bend {

using simd::Float4;
using simd::splat;

/// Less than any squared length, other than 0, of vectors in float. As a lower limit of divisors it prevents
/// NaN.
inline constexpr double min_square = std::numeric_limits<double>::min();

/// The angle of an arc, with the sine and 1 - cosine of its sixteenth, eighth, quarter, half and whole.
struct Arc {
    static constexpr int doublings = 4;
    double angle;  // up to pi; more than 0, so that it can be divided by
    double sine[doublings + 1], versine[doublings + 1];

    explicit Arc(double of) noexcept : angle(std::max(of, 1e-30)) {
        const double a = angle / (1 << doublings), aa = a * a;
        constexpr auto one_over = [](double n) { return 1 / n; };
        sine[0] = a * (1 - aa * one_over(6) * (1 - aa * one_over(20) * (1 - aa * one_over(42))));
        versine[0] = aa * 0.5 * (1 - aa * one_over(12) * (1 - aa * one_over(30) * (1 - aa * one_over(56))));
        for (int i = 0; i < doublings; ++i) {
            sine[i + 1] = 2 * sine[i] * (1 - versine[i]);
            versine[i + 1] = 2 * versine[i] * (2 - versine[i]);
        }
    }
};

/// Sixteen samples at equal steps along a region's center line, the last of them at its end.
struct CenterSamples {
    static constexpr int fours = 4, count = 4 * fours;

    glm::dvec3 begin;                   // where the region begins
    double length;                      // of the center line
    glm::vec3 across, onward;           // at the beginning: toward the arc's center, and along the axis
    Float4 arc_x[fours], arc_z[fours];  // the samples along `across` and `onward`, in units of `length`

    /// Adds angles by the addition theorems: the first four samples, then twice as many in each step.
    CenterSamples(const glm::dvec3& from, double whole, const glm::dvec3& n, const glm::dvec3& t,
                  const Arc& arc) noexcept
        : begin(from), length(whole), across(n), onward(t) {
        const auto angle = static_cast<float>(arc.angle);
        const double per_angle = 1 / arc.angle;
        const auto sine = [&](int i) { return static_cast<float>(arc.sine[i] * per_angle); };
        const auto versine = [&](int i) { return static_cast<float>(arc.versine[i] * per_angle); };
        const float s1 = sine(0), s2 = sine(1), v1 = versine(0), v2 = versine(1);
        arc_z[0] = Float4{s1, s2, s1 + s2 - angle * (s1 * v2 + v1 * s2), sine(2)};
        arc_x[0] = Float4{v1, v2, v1 + v2 + angle * (s1 * s2 - v1 * v2), versine(2)};
        for (int known = 1, doubling = 2; known < fours; known *= 2, ++doubling) {
            const Float4 s = splat(sine(doubling)), v = splat(versine(doubling));
            for (int i = 0; i < known; ++i) {
                arc_z[known + i] = s + arc_z[i] - splat(angle) * (s * arc_x[i] + v * arc_z[i]);
                arc_x[known + i] = v + arc_x[i] + splat(angle) * (s * arc_z[i] - v * arc_x[i]);
            }
        }
    }

    [[nodiscard]] glm::dvec3 operator[](int i) const noexcept {
        return begin + length * glm::dvec3(arc_x[i / 4][i % 4] * across + arc_z[i / 4][i % 4] * onward);
    }
};

}  // namespace goffer::bend
