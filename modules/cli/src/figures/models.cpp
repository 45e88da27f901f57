// SPDX-License-Identifier: MIT
#include "figures/bending.hpp"
#include "figures/figure.hpp"
#include "picture.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

/// Figures 7, 8 and further ones: detailed models, by the paper's method and by goffer's defaults.

namespace goffer::cli {
namespace {

Table model_table() {
    return Table({"method", "angle_degrees", "area_change", "bare_area_change", "base_area_change",
                  "local_rms", "local_worst", "bare_local_rms", "wrinkle_depth", "radius", "folds",
                  "largest_angle_degrees", "vertices", "triangles", "picture"});
}

void add_row(Table& table, const BoundModel& model, const std::string& method, double angle,
             const BentState& state, const std::string& picture) {
    const std::optional<double>& base = state.base_area_change;
    table.add({method, angle, state.area_change, state.bare_area_change,
               base ? Table::Cell(*base) : Table::Cell(), state.local.bent.rms, state.local.bent.worst,
               state.local.without_wrinkles.rms, state.wrinkle_depth, model.cylinder.radius,
               static_cast<double>(model.binding.folds()), largest_by(model.binding.body),
               static_cast<double>(model.mesh.positions.size()),
               static_cast<double>(mesh::triangle_count(model.mesh)), picture});
}

/// The angles that are wanted and, where one is beyond the largest, that.
std::vector<double> angles_within(const std::vector<double>& wanted, double largest) {
    std::vector<double> angles;
    for (const double angle : wanted)
        if (angle < largest) angles.push_back(angle);
    if (angles.size() < wanted.size()) angles.push_back(largest);
    return angles;
}

std::string words(const Table& t) {
    const std::size_t paper = t.rows() - 2, goffer = t.rows() - 1;
    const auto of = [&](std::size_t row, const char* column, Shown shown) {
        return html(t, row, column, shown);
    };
    return "Left by the paper&rsquo;s method (<code>goffer bend --paper</code>: one radius, damped folds, "
           "the "
           "amplitude of "
           "equation 7), on a mesh of " +
           of(paper, "vertices", Shown::whole) +
           " vertices; right by goffer&rsquo;s defaults (the body&rsquo;s own radii, even folds, " +
           "an amplitude that keeps the area of the mesh), on one of " +
           of(goffer, "vertices", Shown::whole) +
           ". Both meshes were refined where folds needed vertices. Bent by " +
           of(goffer, "angle_degrees", Shown::plain) + " degrees, the area changes by " +
           of(paper, "area_change", Shown::change) + " on the left and by " +
           of(goffer, "area_change", Shown::change) + " on the right; without wrinkles it would by " +
           of(goffer, "bare_area_change", Shown::change) +
           " there. Slice by slice and side by side it is off by " + of(paper, "local_rms", Shown::percent) +
           " and " + of(goffer, "local_rms", Shown::percent) +
           " (root mean square). Angles count from the shape at rest.";
}

}  // namespace

Figure model_figure(Workshop& workshop, const BoundModel& by_paper, const BoundModel& by_goffer, int number,
                    const mesh::Limits& limits) {
    const std::string file = by_goffer.file.filename().string();
    Figure figure{
        .name = number <= 8 ? "figure_" + std::to_string(number) : "model_" + std::to_string(number - 6),
        .title = (number <= 8 ? "Figure " + std::to_string(number) + ": " : "A further model: ") + file,
        .table = model_table()};
    // Both are of one file: the mesh of one was refined further.
    const std::array textures{textures_of(by_paper.mesh, limits), textures_of(by_goffer.mesh, limits)};
    const double largest = std::min(largest_by(by_paper.binding.body), largest_by(by_goffer.binding.body));
    for (const double angle : angles_within(workshop.plan.model_angles, largest)) {
        figure.pictures.emplace_back();
        for (const BoundModel* const model : {&by_paper, &by_goffer}) {
            const std::string method = model == &by_paper ? "paper" : "goffer";
            const BentState state = bent_state(*model, pose_by(model->binding.body, angle));
            const std::string picture = picture_name(figure.name + "_" + method, angle);
            draw_state(workshop, *model, state, vertex_colors(model->mesh, model->rest, plain_color(0)),
                       textures[model == &by_paper ? 0 : 1], picture);
            add_row(figure.table, *model, method, angle, state, picture);
            const std::size_t row = figure.table.rows() - 1;
            figure.pictures.back().push_back(
                {picture, html(figure.table, row, "method") + ", " +
                              html(figure.table, row, "angle_degrees") + " degrees: area " +
                              html(figure.table, row, "area_change", Shown::change) + ", locally " +
                              html(figure.table, row, "local_rms", Shown::percent)});
        }
    }
    figure.paragraphs.push_back(words(figure.table));
    return figure;
}

}  // namespace goffer::cli
