// SPDX-License-Identifier: MIT
#include "places.hpp"

#include <goffer/fit/normals.hpp>

#include <glm/geometric.hpp>

#include <cmath>

namespace goffer::fit {
namespace {

/// The normals of the triangles at each vertex, weighted by their angles there.
std::vector<glm::dvec3> angle_weighted(std::span<const glm::vec3> positions,
                                       std::span<const std::uint32_t> triangles) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 at = positions[triangles[t + i]];
            const glm::dvec3 u = glm::dvec3(positions[triangles[t + (i + 1) % 3]]) - at;
            const glm::dvec3 v = glm::dvec3(positions[triangles[t + (i + 2) % 3]]) - at;
            const glm::dvec3 cross = glm::cross(u, v);
            const double twice_area = glm::length(cross);
            if (twice_area == 0) continue;
            sums[triangles[t + i]] += cross * (std::atan2(twice_area, glm::dot(u, v)) / twice_area);
        }
    }
    return sums;
}

}  // namespace

std::vector<glm::vec3> make_normals(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> triangles) {
    const std::vector<glm::dvec3> own = angle_weighted(positions, triangles);
    const std::vector<std::uint32_t> place = places(positions);
    std::vector<glm::dvec3> shared(positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < own.size(); ++i) shared[place[i]] += own[i];

    // Where the sides of a sheet meet, back to back, they cancel: then each keeps its own.
    constexpr double canceled = 1e-6;
    std::vector<glm::vec3> normals;
    normals.reserve(positions.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const glm::dvec3& sum = glm::length(shared[place[i]]) > canceled ? shared[place[i]] : own[i];
        const double length = glm::length(sum);
        normals.emplace_back(length > canceled ? sum / length : glm::dvec3(0, 0, 1));
    }
    return normals;
}

}  // namespace goffer::fit
