// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/capsules.hpp>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <span>

/// What lies in capsules.

namespace goffer::test {

inline double distance_to_capsule(const glm::dvec3& p, const bend::Capsule& capsule) {
    const glm::dvec3 a(capsule.from), step = glm::dvec3(capsule.to) - a;
    const double squared = glm::dot(step, step);
    const double t = squared > 0 ? std::clamp(glm::dot(p - a, step) / squared, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * step);
}

/// Whether one of them holds the place.
inline bool hold(std::span<const bend::Capsule> capsules, const glm::dvec3& p) {
    return std::ranges::any_of(capsules, [&](const bend::Capsule& capsule) {
        return distance_to_capsule(p, capsule) <= static_cast<double>(capsule.radius);
    });
}

}  // namespace goffer::test
