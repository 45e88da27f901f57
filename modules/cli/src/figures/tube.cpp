// SPDX-License-Identifier: MIT
#include "figures/tube.hpp"

#include <goffer/fit/bind.hpp>

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace goffer::cli {

namespace {

/// The divisor of `vertices` that makes cells most nearly as wide as high: 2 pi r / L times as many columns
/// as rows.
std::size_t columns_for(std::size_t vertices) {
    const auto wanted = static_cast<std::size_t>(std::lround(
        std::sqrt(static_cast<double>(vertices) * 2 * std::numbers::pi * Tube::radius / Tube::length)));
    for (std::size_t away = 0; away < wanted; ++away) {
        if (vertices % (wanted + away) == 0) return wanted + away;
        if (vertices % (wanted - away) == 0) return wanted - away;
    }
    return vertices;
}

}  // namespace

Tube::Tube(std::size_t count) {
    const std::size_t columns = columns_for(count), rows = count / columns;
    assert(columns >= 3 && rows >= 2);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const double beta =
                2 * std::numbers::pi * static_cast<double>(column) / static_cast<double>(columns);
            const double z = length * static_cast<double>(row) / static_cast<double>(rows - 1);
            vertices.push_back({beta, z, radius * (1 + 0.05 * std::sin(3 * beta) * std::cos(2 * z))});
            if (row + 1 == rows) continue;
            const auto at = [&](std::size_t r, std::size_t c) {
                return static_cast<std::uint32_t>(r * columns + c % columns);
            };
            const std::uint32_t a = at(row, column), b = at(row, column + 1);
            const std::uint32_t c = at(row + 1, column), d = at(row + 1, column + 1);
            triangles.insert(triangles.end(), {a, b, c, b, d, c});
        }
    }
}

bend::Body Tube::body() const {
    std::vector<glm::vec3> positions;
    positions.reserve(vertices.size());
    for (const paper::Cylindrical& vertex : vertices) positions.emplace_back(paper::from_cylindrical(vertex));
    fit::Cylinder cylinder;
    cylinder.length = length;
    cylinder.radius = radius;
    fit::BindOptions options = fit::BindOptions::as_in_paper();
    options.folds = folds;
    return std::move(fit::bind({.positions = positions, .triangles = triangles}, cylinder, options).body);
}

bend::Pose varied_pose(std::size_t index) {
    const auto at = static_cast<float>(index % 10'000);
    return {2.0f * std::numbers::pi_v<float> / 3 * (0.5f - 0.5f * std::cos(0.1f + 0.37f * at)), 0.61f * at};
}

}  // namespace goffer::cli
