// SPDX-License-Identifier: MIT
#include "goffer/paper/grid.hpp"

#include "bend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace goffer::paper {
namespace {

constexpr double turn = 2 * std::numbers::pi;

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return (1 - t) * a + t * b;
}

}  // namespace

Grid::Grid(const Parameters& body, std::uint32_t columns, std::uint32_t rows)
    : body_(body), columns_(columns), rows_(rows) {
    if (columns < 3 || rows < 2) {
        throw std::invalid_argument("the grid is " + std::to_string(columns) + " x " + std::to_string(rows) +
                                    ": it needs 3 columns and 2 rows or more");
    }
    if (body.shape) throw std::invalid_argument("shape: the paper's grid has none");
    if (!body.folds.whole()) throw std::invalid_argument("folds: the paper's grid has no wave that runs on");
    static_cast<void>(bend_of(body, {}));  // throws if length, radius or folds is out of range
}

GridVertex Grid::bind(const Cylindrical& vertex) const {
    if (!std::isfinite(vertex.beta) || !std::isfinite(vertex.z) || !std::isfinite(vertex.rho)) {
        throw std::invalid_argument("a vertex has a coordinate that is not finite: it cannot be bound");
    }
    const double step = turn / columns_;
    const double beta = vertex.beta - turn * std::floor(vertex.beta / turn);
    const double column = std::min(std::floor(beta / step), columns_ - 1.0);
    const double height = vertex.z / body_.length * (rows_ - 1);
    const double row = std::clamp(std::floor(height), 0.0, rows_ - 2.0);

    // The base grid's cross-section is a polygon: the ray at beta meets the chord of its cell at the fraction
    // sin(t) / (sin(t) + sin(step - t)), a little nearer to the axis than r.
    const double t = beta - column * step;
    const double across = std::sin(t) / (std::sin(t) + std::sin(step - t));
    const double chord = std::cos(step / 2) / std::cos(t - step / 2);
    return {static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), across, height - row,
            vertex.rho / chord - body_.radius};
}

BentGrid Grid::bend(const Pose& pose) const {
    const ClosedForm map(body_, pose);
    const Bend bend = bend_of(body_, pose);
    BentGrid bent;
    bent.columns_ = columns_;
    bent.rows_ = rows_;
    bent.radius_ = body_.radius;
    bent.nodes_.resize(BentGrid::shells.size() * columns_ * rows_);
    for (std::uint32_t column = 0; column < columns_; ++column) {
        const double beta = turn * column / columns_;
        const double amplitude = map.column_amplitude(beta);  // eq 7-10, once per column
        for (std::uint32_t row = 0; row < rows_; ++row) {
            const double u = std::abs(2.0 * row / (rows_ - 1) - 1);
            const double oscillation =
                body_.folds.count > 0 ? shape(body_.profile, body_.folds.count, u) : 0;  // eq 6
            for (std::size_t shell = 0; shell < BentGrid::shells.size(); ++shell) {
                const double rho = BentGrid::shells[shell] * body_.radius;
                const double wrinkle = amplitude * oscillation * depth_weight(rho, body_.radius);
                const Cylindrical rest{beta, body_.length * row / (rows_ - 1), rho};
                bent.nodes_[bent.index(shell, column, row)] = bend.position(rest, wrinkle);
            }
        }
    }
    return bent;
}

std::size_t BentGrid::index(std::size_t shell, std::uint32_t column, std::uint32_t row) const {
    return (shell * rows_ + row) * columns_ + column;
}

const glm::dvec3& BentGrid::node(std::uint32_t column, std::uint32_t row) const {
    return nodes_[index(shells.size() - 1, column, row)];
}

glm::dvec3 BentGrid::on_shell(std::size_t shell, const GridVertex& vertex) const {
    const std::uint32_t next = (vertex.column + 1) % columns_;
    const auto ring = [&](std::uint32_t row) {
        return between(nodes_[index(shell, vertex.column, row)], nodes_[index(shell, next, row)],
                       vertex.across);
    };
    return between(ring(vertex.row), ring(vertex.row + 1), vertex.along);
}

glm::dvec3 BentGrid::position(const GridVertex& vertex) const {
    const double depth = 1 + vertex.detail / radius_;
    const std::size_t inner = depth < shells[1] ? 0 : 1;
    const double t = (depth - shells[inner]) / (shells[inner + 1] - shells[inner]);
    return between(on_shell(inner, vertex), on_shell(inner + 1, vertex), t);
}

}  // namespace goffer::paper
