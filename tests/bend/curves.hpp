// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

/// Curves that bodies are laid along, as polylines.

namespace goffer::test {

/// Control points of a Bezier curve.
using Control = glm::vec3[4];

inline glm::dvec3 point_of(const Control& control, double t) {
    const double u = 1 - t;
    return u * u * u * glm::dvec3(control[0]) + 3 * u * u * t * glm::dvec3(control[1]) +
           3 * u * t * t * glm::dvec3(control[2]) + t * t * t * glm::dvec3(control[3]);
}

/// The curve as a polyline, and a long piece straight on from its end.
inline std::vector<glm::dvec3> line_of(const Control& control, int pieces) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= pieces; ++i) points.push_back(point_of(control, static_cast<double>(i) / pieces));
    points.push_back(points.back() + 100.0 * glm::normalize(glm::dvec3(control[3]) - glm::dvec3(control[2])));
    return points;
}

inline double distance_to_polyline(const glm::dvec3& p, std::span<const glm::dvec3> points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec3 step = points[i + 1] - points[i];
        const double t = std::clamp(glm::dot(p - points[i], step) / glm::dot(step, step), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, points[i] + t * step));
    }
    return nearest;
}

}  // namespace goffer::test
