// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/closed_form.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

/// The paper's own pipeline, on a grid, in double. The model is taken apart into a base cylinder and a radial
/// difference per vertex (the detail). The base grid is bent (eq 2-5) and wrinkled (eq 6-10, solved once per
/// column), and the detail is put back by trilinear interpolation from the grid.
///
///     const Grid grid(body, columns, rows);  // initialization part
///     const GridVertex at = grid.bind(vertex);
///     const BentGrid bent = grid.bend(pose);  // deformation part
///     const glm::dvec3 position = bent.position(at);
///
/// As the grid is refined, the result converges to ClosedForm: with the square of the cell size if a column
/// lies on the outer line and, for Profile::damped, a row on mid-height, where the wrinkle has its creases;
/// else with the first power in the cells that a crease cuts.
/// See modules/paper/README.md, "Wrinkle". All functions are thread-safe.

namespace goffer::paper {

/// A vertex in terms of the grid.
struct GridVertex {
    std::uint32_t column = 0;  ///< the vertex lies between this column of the grid and the next
    std::uint32_t row = 0;     ///< and between this row and the next
    double across = 0;         ///< 0..1 from column to column, on the chord between them
    double along = 0;          ///< 0..1 from row to row; outside of that for a vertex beyond the ends
    /// Radial difference, model units: rho / c - r, where c r is how far the chord is from the axis at this
    /// beta.
    double detail = 0;
};

/// A grid in one pose: what the merge interpolates from. Immutable. A default-constructed one is empty.
class BentGrid {
public:
    /// Returns the deformed position, in the body frame, of a vertex that the same Grid has bound: trilinear
    /// in the cell and between the two shells around it. In the rest pose this is the rest position.
    [[nodiscard]] glm::dvec3 position(const GridVertex& vertex) const;

    /// Returns the deformed position of a point of the base grid; `column` and `row` must be in range.
    [[nodiscard]] const glm::dvec3& node(std::uint32_t column, std::uint32_t row) const;

private:
    friend class Grid;
    /// Shells of the grid, in radii: the axis, the depth from which the wrinkle is full, and the base
    /// cylinder. Between them the map is linear in rho, and beyond the base it goes on like below it, so that
    /// the radial part of the merge is exact.
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
    /// `columns` counts the vertices around, the first at beta = 0; `rows` counts the rings of vertices from
    /// z = 0 to z = L. Throws std::invalid_argument if columns < 3 or rows < 2, if length or radius is not a
    /// finite number above 0, if folds is negative, or if there is a shape or its wave runs on over joints.
    Grid(const Parameters& body, std::uint32_t columns, std::uint32_t rows);

    /// Finds the cell of a vertex and its detail. beta may be any angle; z beyond the ends is extrapolated
    /// from the last cell. Throws std::invalid_argument if a coordinate is not finite.
    [[nodiscard]] GridVertex bind(const Cylindrical& vertex) const;

    /// Bends and wrinkles the grid. Throws std::invalid_argument as ClosedForm's constructor does.
    [[nodiscard]] BentGrid bend(const Pose& pose) const;

private:
    Parameters body_;
    std::uint32_t columns_;
    std::uint32_t rows_;
};

}  // namespace goffer::paper
