// SPDX-License-Identifier: MIT
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace goffer::fit {

/// A triangle of a mesh, in double.
struct Triangle {
    std::array<glm::dvec3, 3> corner;

    /// `corners`: three vertices, counterclockwise seen from outside.
    Triangle(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners)
        : corner{positions[corners[0]], positions[corners[1]], positions[corners[2]]} {}

    /// Points outward; its length is twice the area.
    [[nodiscard]] glm::dvec3 normal() const {
        return glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    }
    [[nodiscard]] double area() const { return glm::length(normal()) / 2; }
    [[nodiscard]] glm::dvec3 centroid() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
};

}  // namespace goffer::fit
