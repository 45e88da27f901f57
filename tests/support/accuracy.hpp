// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"
#include "support/worst.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

/// How far the kernels are from the double reference.

namespace goffer::test {

/// A reference's values for the vertices of a body, which every instruction set is held against.
struct Expected {
    std::vector<glm::dvec3> positions, normals, tangents;

    template <class Map>
    Expected(const Map& reference, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            positions.push_back(reference.position(i));
            normals.push_back(reference.normal(i));
            tangents.push_back(reference.tangent(i));
        }
    }
};

/// The largest differences; NaN counts as the largest of all.
struct Worst {
    double position = 0;  // of L, or of what the test says
    double normal = 0;    // degrees
    double tangent = 0;   // degrees
    double unit = 0;      // | |n| - 1 |
    double skew = 0;      // normal . tangent, which are orthogonal at rest

    Worst() = default;
    Worst(const Expected& expected, const Output& out, double length) {
        for (std::size_t i = 0; i < expected.positions.size(); ++i) {
            take_worst(position, glm::length(out.position(i) - expected.positions[i]) / length);
            take_worst(normal, angle_between(out.normal(i), expected.normals[i]));
            take_worst(tangent, angle_between(out.tangent(i), expected.tangents[i]));
            take_worst(unit, std::fabs(glm::length(out.normal(i)) - 1));
            take_worst(unit, std::fabs(glm::length(out.tangent(i)) - 1));
            take_worst(skew, std::fabs(glm::dot(out.normal(i), out.tangent(i))));
        }
    }

    void add(const Worst& other) {
        take_worst(position, other.position);
        take_worst(normal, other.normal);
        take_worst(tangent, other.tangent);
        take_worst(unit, other.unit);
        take_worst(skew, other.skew);
    }
};

}  // namespace goffer::test
