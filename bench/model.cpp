// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/paper/closed_form.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace goffer::bench {
namespace {

constexpr double rest_angle = 1;

/// The divisor of `vertices` nearest to the number of columns that makes rows four times as many.
std::size_t columns_for(std::size_t vertices) {
    const auto wanted = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(vertices) / 4)));
    for (std::size_t away = 0; away < wanted; ++away) {
        if (vertices % (wanted + away) == 0) return wanted + away;
        if (vertices % (wanted - away) == 0) return wanted - away;
    }
    return 1;
}

}  // namespace

Grid::Grid(std::size_t vertices) : columns(columns_for(vertices)), rows(vertices / columns) {}

double Grid::beta(std::size_t column) const {
    return 2 * std::numbers::pi * static_cast<double>(column) / static_cast<double>(columns);
}

double Grid::z(std::size_t row) const {
    return length * static_cast<double>(row) / static_cast<double>(rows - 1);
}

double Grid::rho(double beta, double z) {
    return radius * (1 + 0.05 * std::sin(3 * beta) * std::cos(2 * z));
}

Model::Model(std::size_t vertices, Shape like) : shape(like) {
    const paper::ClosedForm bent({.length = length, .radius = radius},
                                 {shape == Shape::arc ? rest_angle : 0, 0});
    const Grid grid(vertices);
    const auto index = [&](std::size_t row, std::size_t column) {
        return static_cast<std::uint32_t>(row * grid.columns + column % grid.columns);
    };
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const double beta = grid.beta(column);
            const double thickness = shape == Shape::taper ? 1.4 - 0.8 * grid.z(row) / length : 1;
            const double rho = thickness * Grid::rho(beta, grid.z(row));
            positions.emplace_back(bent.position({beta, grid.z(row), rho}));
            tangents.emplace_back(-std::sin(beta), std::cos(beta), 0, 1);
            if (row + 1 == grid.rows) continue;
            const std::uint32_t a = index(row, column);
            const std::uint32_t b = index(row, column + 1);
            const std::uint32_t c = index(row + 1, column);
            const std::uint32_t d = index(row + 1, column + 1);
            triangles.insert(triangles.end(), {a, b, c, b, d, c});
        }
    }
}

bend::Body bind_model(const Model& model) {
    fit::Cylinder cylinder;
    cylinder.length = length;
    cylinder.radius = radius;
    fit::BindOptions options = fit::BindOptions::as_in_paper();
    options.folds = folds;
    if (model.shape == Shape::regions) {
        options.folds = 1;
        options.regions.assign(8, {1.0 / 8, std::nullopt});
    }
    if (model.shape == Shape::joints) {
        options = {};
        options.shape = fit::ShapeMode::cylinder;
        options.regions.assign(8, {1.0 / 8, 3});
    }
    if (model.shape == Shape::regions16) {
        options.folds = 0;
        options.regions.assign(16, {1.0 / 16, std::nullopt});
    }
    if (model.shape == Shape::arc) {
        cylinder.rest_angle = rest_angle;
        options.onset.reset();
    }
    if (model.shape == Shape::taper) {
        cylinder.radii = {1.4 * radius, 0.6 * radius};
        options.shape = fit::ShapeMode::automatic;
    }
    const fit::Geometry geometry{
        .positions = model.positions, .triangles = model.triangles, .tangents = model.tangents};
    return std::move(fit::bind(geometry, cylinder, options).body);
}

bend::Body make_body(std::size_t vertices, Shape shape) {
    return bind_model(Model(vertices, shape));
}

}  // namespace goffer::bench
