// SPDX-License-Identifier: MIT
#include "subject.hpp"

#include <goffer/fit/bind.hpp>

#include <cmath>
#include <numbers>

namespace goffer::bench {
namespace {

struct Grid {
    int columns, rows;

    explicit Grid(std::size_t vertices)
        : columns(static_cast<int>(std::lround(std::sqrt(static_cast<double>(vertices) / 4)))),
          rows(static_cast<int>(vertices) / columns) {}

    [[nodiscard]] double beta(int column) const { return 2 * std::numbers::pi * column / columns; }
    [[nodiscard]] double z(int row) const { return length * row / (rows - 1); }
    [[nodiscard]] static double rho(double beta, double z) {
        return radius * (1 + 0.05 * std::sin(3 * beta) * std::cos(2 * z));
    }
};

}  // namespace

bend::Body make_body(std::size_t vertices) {
    const Grid grid(vertices);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const double beta = grid.beta(column);
            const double rho = Grid::rho(beta, grid.z(row));
            positions.emplace_back(rho * std::cos(beta), rho * std::sin(beta), grid.z(row));
            if (row + 1 == grid.rows) continue;
            const auto index = [&](int r, int c) {
                return static_cast<std::uint32_t>(r * grid.columns + c % grid.columns);
            };
            const std::uint32_t a = index(row, column), b = index(row, column + 1),
                                c = index(row + 1, column);
            triangles.insert(triangles.end(), {a, b, c, b, index(row + 1, column + 1), c});
        }
    }
    fit::Cylinder cylinder;
    cylinder.length = length;
    cylinder.radius = radius;
    fit::BindOptions options;
    options.folds = folds;
    return std::move(fit::bind({positions, triangles}, cylinder, options).body);
}

NaiveBody make_naive(std::size_t vertices) {
    const Grid grid(vertices);
    NaiveBody body;
    for (int column = 0; column < grid.columns; ++column) body.column_beta.push_back(grid.beta(column));
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const double beta = grid.beta(column);
            body.vertices.push_back({beta, grid.z(row), Grid::rho(beta, grid.z(row)), 1, 0, 0, column});
        }
    }
    return body;
}

}  // namespace goffer::bench
