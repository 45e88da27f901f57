// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

/// Interpolates the values of two vertices at (1 - t) a + t b, in double.

namespace goffer::mesh {

template <glm::length_t n>
[[nodiscard]] glm::vec<n, float> linear(const glm::vec<n, float>& a, const glm::vec<n, float>& b, double t) {
    using Double = glm::vec<n, double>;
    return glm::vec<n, float>(Double(a) + t * (Double(b) - Double(a)));
}

/// Interpolates directions; the result has unit length. Where the two cancel, it is that of the nearer end;
/// where both are zero, it is zero.
[[nodiscard]] inline glm::vec3 direction(const glm::vec3& a, const glm::vec3& b, double t) {
    const auto unit = [](const glm::dvec3& v) {
        const double length = glm::length(v);
        return length > 0 ? v / length : v;
    };
    const glm::dvec3 from = unit(a), to = unit(b), sum = from + t * (to - from);
    const glm::dvec3 &near = t < 0.5 ? from : to, &far = t < 0.5 ? to : from;
    if (glm::length(sum) > 1e-6) return glm::vec3(unit(sum));
    return glm::vec3(glm::length(near) > 0 ? near : far);
}

/// Interpolates tangents: the direction, with the sign (w) of the nearer end.
[[nodiscard]] inline glm::vec4 tangent_between(const glm::vec4& a, const glm::vec4& b, double t) {
    return {direction(glm::vec3(a), glm::vec3(b), t), t < 0.5 ? a.w : b.w};
}

}  // namespace goffer::mesh
