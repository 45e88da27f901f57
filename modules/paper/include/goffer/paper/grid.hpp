// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/closed_form.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

/// The paper's own pipeline, on a grid: the model is taken apart into a base cylinder and a radial difference
/// per vertex (the detail), the base grid is bent (eq 2-5) and wrinkled (eq 6-10, solved once per column),
/// and the detail is put back by trilinear interpolation from the grid.
///
///     initialize   Grid grid(body, columns, rows);  GridVertex at = grid.bind(vertex);
///     deform       BentGrid bent = grid.bend(pose);  bent.position(at);
///
/// Chen et al. 2015 (see wrinkle.hpp). As the grid is refined the result converges to ClosedForm: with the
/// square of the cell size, if a column lies on the outer line, and (profile `damped`) a row on mid-height,
/// where the wrinkle has its creases; else with the first power in the cells that a crease cuts.

namespace goffer::paper {

/// A vertex as the grid knows it.
struct GridVertex {
    std::uint32_t column = 0;  ///< of the cell: it lies between this column of the grid and the next
    std::uint32_t row = 0;     ///< likewise
    double across = 0;         ///< where in the cell, 0..1 from column to column (on the chord between them)
    double along = 0;          ///< 0..1 from row to row; beyond that range for a vertex beyond the ends
    double detail =
        0;  ///< radial difference: distance from the axis less that of the grid, in the scale of r
};

/// A grid in one pose: what the merge interpolates from. Immutable; any number of threads may share one.
class BentGrid {
public:
    /// Deformed position in the body frame of a vertex that the same Grid has bound: trilinear in the cell
    /// and between the two shells around it. In the rest pose it is the vertex's rest position.
    [[nodiscard]] glm::dvec3 position(const GridVertex& vertex) const;

    /// Deformed position of a point of the base grid.
    [[nodiscard]] const glm::dvec3& node(std::uint32_t column, std::uint32_t row) const;

private:
    friend class Grid;
    /// The axis, the depth where the wrinkle is full, and the base cylinder itself: in between the map is
    /// linear in rho, and it goes on beyond the base as below: the radial part of the merge is exact.
    static constexpr std::array<double, 3> shells{0, 0.5, 1};

    [[nodiscard]] std::size_t index(std::size_t shell, std::uint32_t column, std::uint32_t row) const;
    [[nodiscard]] glm::dvec3 on_shell(std::size_t shell, const GridVertex& vertex) const;

    std::uint32_t columns_ = 0;
    std::uint32_t rows_ = 0;
    double radius_ = 0;
    std::vector<glm::dvec3> nodes_;
};

/// The base grid of one body at rest.
class Grid {
public:
    /// `columns` >= 3 vertices around, the first at beta = 0; `rows` >= 2 rings of vertices from z = 0 to z =
    /// L. Throws std::invalid_argument below that.
    Grid(const Parameters& body, std::uint32_t columns, std::uint32_t rows);

    /// The cell of a vertex and its detail (initialization part). Any beta; z beyond the ends is extrapolated
    /// from the last cell. Throws std::invalid_argument where a coordinate is not finite.
    [[nodiscard]] GridVertex bind(const Cylindrical& vertex) const;

    /// The grid bent and wrinkled (deformation part). Throws as the constructor of ClosedForm documents.
    [[nodiscard]] BentGrid bend(const Pose& pose) const;

private:
    Parameters body_;
    std::uint32_t columns_;
    std::uint32_t rows_;
};

}  // namespace goffer::paper
