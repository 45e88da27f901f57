// SPDX-License-Identifier: MIT
#include "figures/bending.hpp"
#include "figures/figure.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/paper/base.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// Figures 5 and 6. The grid is drawn as a chessboard, whose squares have vertices of their own.

namespace goffer::cli {
namespace {

constexpr std::uint32_t columns = 96, rows = 321;             // of vertices, the last row at the tip
constexpr std::uint32_t square_columns = 3, square_rows = 8;  // cells of the grid

struct Chessboard {
    BoundModel model;
    std::vector<glm::vec4> colors;
};

fit::Cylinder base_cylinder() {
    fit::Cylinder cylinder;
    cylinder.length = base_length;
    cylinder.radius = base_radius;
    return cylinder;
}

/// The arrays of the grid, four vertices to a cell.
mesh::Mesh split_grid(std::vector<glm::vec4>& colors, std::vector<glm::vec3>& normals) {
    constexpr glm::vec4 dark{0.55f, 0.22f, 0.13f, 1}, light{0.80f, 0.62f, 0.45f, 1};
    const paper::BaseMesh grid = paper::base_mesh(base_length, base_radius, columns, rows);
    paper::BaseMesh split;
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto first = static_cast<std::uint32_t>(split.positions.size());
            const std::uint32_t next = (column + 1) % columns;
            const std::array<std::uint32_t, 4> corners{row * columns + column, row * columns + next,
                                                       (row + 1) * columns + next,
                                                       (row + 1) * columns + column};
            for (const std::uint32_t corner : corners) {
                const glm::dvec3& position = grid.positions[corner];
                split.positions.push_back(position);
                normals.emplace_back(position.x / base_radius, position.y / base_radius, 0);
                colors.push_back((column / square_columns + row / square_rows) % 2 == 0 ? dark : light);
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                split.triangles.push_back(first + corner);
        }
    }
    return mesh_of(split);
}

Chessboard chessboard() {
    Chessboard board;
    std::vector<glm::vec3> normals;
    board.model.file = "the base grid";
    board.model.mesh = split_grid(board.colors, normals);
    board.model.rest = mesh::vertex_arrays(board.model.mesh);
    board.model.rest.normals = std::move(normals);
    board.model.binding =
        fit::bind(geometry_of(board.model.rest), base_cylinder(), fit::BindOptions::as_in_paper());
    board.model.cylinder = board.model.binding.cylinder;
    return board;
}

Table grid_table() {
    return Table({"angle_degrees", "area_factor", "closed_form_area_factor", "inner_column_factor",
                  "local_rms", "local_worst", "wrinkle_depth", "largest_angle_degrees", "length", "radius",
                  "folds_per_half_length", "picture"});
}

/// The length of the inner column, the first one of the grid, over that at rest.
double inner_column_factor(std::span<const glm::vec3> positions) {
    double bent = 0;
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        const std::size_t first = 4 * row * columns;
        bent += glm::distance(glm::dvec3(positions[first]), glm::dvec3(positions[first + 3]));
    }
    return bent / base_length;
}

std::vector<std::string> words(const Figure& figure, bool wrinkled) {
    const Table& t = figure.table;
    const std::size_t last = t.rows() - 1;
    const std::string at = "bent by " + html(t, last, "angle_degrees") + " degrees, it keeps " +
                           html(t, last, "area_factor", Shown::percent) + " of its area";
    std::vector<std::string> text{"The base cylinder, " + html(t, 0, "length") + " long with a radius of " +
                                  html(t, 0, "radius") + ". Its grid is drawn as a chessboard. "};
    if (wrinkled) {
        text[0] +=
            "It is bent as above, and wrinkles by the paper&rsquo;s damped oscillation (equations 6 to 10), "
            "with " +
            html(t, 0, "folds_per_half_length", Shown::whole) + " folds over half the length: " + at +
            ". The closed form of the surface, without a grid, has " +
            html(t, last, "closed_form_area_factor", Shown::percent) + ", and the inner line keeps " +
            html(t, last, "inner_column_factor", Shown::percent) + " of its length.";
    } else {
        text[0] +=
            "It is bent along an arc whose outer line keeps its length (equations 2 to 5), without "
            "wrinkles: " +
            at + "; the closed form, 1 &minus; &alpha; r / L, is " +
            html(t, last, "closed_form_area_factor", Shown::percent) +
            ". The squares along the inner line are squeezed to " +
            html(t, last, "inner_column_factor", Shown::percent) + " of their length.";
    }
    return text;
}

}  // namespace

Figure base_grid_figure(Workshop& workshop, bool wrinkled) {
    Figure figure{.name = wrinkled ? "figure_6" : "figure_5",
                  .title = wrinkled ? "Figure 6: the base grid, bent and wrinkled"
                                    : "Figure 5: the base grid, bent without wrinkles",
                  .table = grid_table()};
    const Chessboard board = chessboard();
    const BoundModel& model = board.model;
    const double largest = largest_by(model.binding.body);
    const int folds = model.binding.folds();
    figure.pictures.emplace_back();
    for (const double wanted : workshop.plan.grid_angles) {
        const double angle = std::min(wanted, largest);
        const BentState state = bent_state(model, pose_by(model.binding.body, angle), wrinkled);
        const std::string file = picture_name(figure.name, angle);
        draw_state(workshop, model, state, board.colors, {}, file);
        const double closed = paper::lateral_area(paper::Profile::damped, folds, base_length, base_radius,
                                                  radians(angle), wrinkled ? 1 : 0);
        figure.table.add({angle, 1 + state.area_change, closed, inner_column_factor(state.records.positions),
                          state.local.bent.rms, state.local.bent.worst, state.wrinkle_depth, largest,
                          base_length, base_radius, static_cast<double>(folds), file});
        const std::size_t row = figure.table.rows() - 1;
        figure.pictures[0].push_back({file, html(figure.table, row, "angle_degrees") + " degrees: area " +
                                                html(figure.table, row, "area_factor", Shown::percent)});
    }
    figure.paragraphs = words(figure, wrinkled);
    return figure;
}

}  // namespace goffer::cli
