// SPDX-License-Identifier: MIT
#pragma once

#include "figures/tables.hpp"

#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What a figure is, and what all of them are made with.

namespace goffer::io {
class AtomicFiles;
}

namespace goffer::cli {

struct BoundModel;

/// The cylinder of the figures that have no model.
inline constexpr double base_length = 10, base_radius = 1;

/// A picture of a figure, in the folder of the page.
struct FigurePicture {
    std::string file;
    std::string caption;  ///< HTML
};

/// A figure as the page shows it. Its files are NAME.csv and, where it has a chart, NAME.gp and NAME.svg.
struct Figure {
    std::string name;
    std::string title;
    Table table;
    std::optional<Table> summary = {};         ///< NAME_summary.csv
    std::vector<std::string> paragraphs = {};  ///< HTML; each number is a cell of the table or the summary
    std::vector<std::vector<FigurePicture>> pictures = {};  ///< those of a row are side by side
    std::string script = {};  ///< what gnuplot draws the chart by; empty: there is none
};

/// How much is done.
struct FigurePlan {
    std::vector<double> grid_angles{45, 90, 135, 180};  ///< degrees, of Figures 5 and 6
    std::vector<double> model_angles{30, 60, 90};       ///< degrees from the rest pose
    std::size_t area_samples = 25;
    int runs = 7, frames = 500;  ///< of Figure 9
    std::size_t most_vertices = 1'000'000;
    std::size_t most_instances = 10'000;
    double seconds = 0.1;  ///< at least, for each time of the last figures

    [[nodiscard]] static FigurePlan sparing() {
        return {.grid_angles = {90},
                .model_angles = {60},
                .area_samples = 5,
                .runs = 3,
                .frames = 20,
                .most_vertices = 10'000,
                .most_instances = 100,
                .seconds = 0.005};
    }
};

/// What figures are made with, and where their files go.
struct Workshop {
    FigurePlan plan;
    view::Settings picture;
    int threads = 1;
    std::filesystem::path folder;
    io::AtomicFiles& files;
};

/// Figures 5 and 6: the base grid bent in several poses, without wrinkles and with them.
[[nodiscard]] Figure base_grid_figure(Workshop& workshop, bool wrinkled);

/// A model bent by the paper's method and by goffer's defaults, in several poses; with its file's name as
/// fit and the reader have it. `number`: 7 and 8 are the paper's. `limits`: what its textures may take.
[[nodiscard]] Figure model_figure(Workshop& workshop, const BoundModel& by_paper, const BoundModel& by_goffer,
                                  int number, const mesh::Limits& limits);

/// Figure 9: the time of each step of a frame. `device`: gets what OpenGL runs on, or why it does not.
[[nodiscard]] Figure timing_figure(Workshop& workshop, std::string& device);

/// The length of the inner column, fold by fold, for each profile.
[[nodiscard]] Figure fold_figure();

/// The area of a model against the angle: bare, skinned, and by each amplitude. `model`: with goffer's
/// defaults.
[[nodiscard]] Figure area_figure(Workshop& workshop, const BoundModel& model);

/// Nanoseconds per vertex against the vertices of one body, and against the instances of a crowd.
[[nodiscard]] Figure vertices_figure(Workshop& workshop);
[[nodiscard]] Figure instances_figure(Workshop& workshop);

}  // namespace goffer::cli
