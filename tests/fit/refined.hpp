// SPDX-License-Identifier: MIT
#pragma once

#include "synthetic.hpp"

#include <goffer/fit/refine.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <map>
#include <span>
#include <utility>

/// Examines refinements.

namespace goffer::test {

using Place = std::array<std::uint32_t, 3>;

inline Place place(const glm::vec3& p) {
    const glm::vec3 q = p + 0.0f;
    return {std::bit_cast<std::uint32_t>(q.x), std::bit_cast<std::uint32_t>(q.y),
            std::bit_cast<std::uint32_t>(q.z)};
}

/// The length of the borders: of edges that no other triangle runs along the other way, with vertices of the
/// same position, bit for bit, taken as one. 0 for a closed surface.
inline double border(const Solid& solid) {
    std::map<std::pair<Place, Place>, int> runs;
    double length = 0;
    for (std::size_t t = 0; t < solid.triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Place a = place(solid.positions[solid.triangles[t + i]]);
            const Place b = place(solid.positions[solid.triangles[t + (i + 1) % 3]]);
            if (a < b) ++runs[{a, b}];
            if (b < a) --runs[{b, a}];
        }
    }
    const auto point = [](const Place& p) {
        return glm::dvec3(std::bit_cast<float>(p[0]), std::bit_cast<float>(p[1]), std::bit_cast<float>(p[2]));
    };
    for (const auto& [edge, count] : runs)
        length += std::abs(count) * glm::distance(point(edge.first), point(edge.second));
    return length;
}

inline Solid applied(const Solid& solid, const fit::Refinement& refinement) {
    return {fit::refined_positions(solid.positions, refinement), refinement.triangles};
}

inline glm::dvec3 area_vector(const Solid& solid, std::size_t triangle) {
    const auto at = [&](std::size_t i) {
        return glm::dvec3(solid.positions[solid.triangles[3 * triangle + i]]);
    };
    return glm::cross(at(1) - at(0), at(2) - at(0)) / 2.0;
}

/// 1 for an equilateral triangle, 0 for a degenerate one.
inline double quality(const Solid& solid, std::size_t triangle) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = solid.positions[solid.triangles[3 * triangle + i]];
        const glm::dvec3 b = solid.positions[solid.triangles[3 * triangle + (i + 1) % 3]];
        squares += glm::dot(b - a, b - a);
    }
    return 4 * std::sqrt(3.0) * glm::length(area_vector(solid, triangle)) / squares;
}

/// What must hold of every refinement, whatever the mesh.
inline void check_refinement(const Solid& before, const fit::Refinement& refinement, double unit) {
    const Solid after = applied(before, refinement);
    REQUIRE(refinement.parents.size() * 3 == refinement.triangles.size());
    CHECK(std::ranges::is_sorted(refinement.parents));
    CHECK(std::ranges::equal(before.positions, std::span(after.positions).first(before.positions.size())));
    CHECK_NOTHROW(fit::check(after.geometry()));
    std::size_t badly_placed = 0, turned = 0, lost = 0, made = before.positions.size();
    for (const fit::EdgeVertex& v : refinement.vertices) {
        badly_placed += !(v.t > 0 && v.t < 1) || v.a >= made || v.b >= made || v.a == v.b;
        ++made;
    }
    std::vector<glm::dvec3> areas(before.triangles.size() / 3, glm::dvec3(0));
    for (std::size_t t = 0; t < refinement.parents.size(); ++t) {
        const glm::dvec3 piece = area_vector(after, t), whole = area_vector(before, refinement.parents[t]);
        turned += glm::dot(piece, whole) < -1e-9 * unit * unit * unit * unit;
        areas[refinement.parents[t]] += piece;
    }
    for (std::size_t t = 0; t < areas.size(); ++t)
        lost += glm::length(areas[t] - area_vector(before, t)) > 1e-5 * unit * unit;
    CHECK(badly_placed == 0);
    CHECK(turned == 0);
    CHECK(lost == 0);
    const double area = fit::surface_area(before.positions, before.triangles);
    CHECK(std::abs(fit::surface_area(after.positions, after.triangles) / area - 1) < 1e-7);
    CHECK(std::abs(border(after) - border(before)) <= 1e-9 * border(before));
}

}  // namespace goffer::test
