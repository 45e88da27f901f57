// SPDX-License-Identifier: MIT
#pragma once

#include "support/angles.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace goffer::test {

/// The tube that most tests bend.
inline constexpr double tube_length = 10, tube_radius = 1;

/// Area of a closed strip of columns x rows points, each quadrilateral cut in two.
template <class Node>
double lateral_area(std::uint32_t columns, std::uint32_t rows, Node&& node) {
    double twice = 0;
    for (std::uint32_t column = 0; column < columns; ++column) {
        for (std::uint32_t row = 0; row + 1 < rows; ++row) {
            const std::uint32_t next = (column + 1) % columns;
            const glm::dvec3 a = node(column, row), c = node(next, row + 1);
            twice += glm::length(glm::cross(node(next, row) - a, c - a)) +
                     glm::length(glm::cross(c - a, node(column, row + 1) - a));
        }
    }
    return twice / 2;
}

}  // namespace goffer::test
