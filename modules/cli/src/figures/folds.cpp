// SPDX-License-Identifier: MIT
#include "figures/figure.hpp"

#include <goffer/paper/closed_form.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

/// The length of the innermost column, fold by fold.

namespace goffer::cli {
namespace {

constexpr double angle = std::numbers::pi / 2;
constexpr int folds = 12;  // from end to end

struct NamedProfile {
    const char* name;
    paper::Profile profile;
};
constexpr std::array profiles{NamedProfile{"damped", paper::Profile::damped},
                              NamedProfile{"smooth", paper::Profile::smooth},
                              NamedProfile{"even", paper::Profile::even}};

/// The length of each fold of the inner column over that at rest, less 1.
std::vector<double> changes(paper::Profile profile) {
    constexpr int steps = 1000;  // a chord of a thousandth of a fold is short by some 1e-6 of it
    const int own_count = folds / profile.folds_of_length(1);
    const paper::ClosedForm map(
        {.length = base_length, .radius = base_radius, .folds = own_count, .profile = profile}, {angle, 0});
    std::vector<double> result;
    for (int fold = 0; fold < folds; ++fold) {
        const auto at = [&](int step) {
            return map.position(
                {0, base_length * (fold + static_cast<double>(step) / steps) / folds, base_radius});
        };
        double bent = 0;
        for (int step = 0; step < steps; ++step) bent += glm::distance(at(step), at(step + 1));
        result.push_back(bent / (base_length / folds) - 1);
    }
    return result;
}

Table::Cell rms(const std::vector<double>& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

Table::Cell worst(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::fabs(value) > std::fabs(most) ? value : most;
    return most;
}

constexpr const char* folds_script = R"gp(set xlabel "fold, from base to tip"
set ylabel "change of length, per cent"
set xrange [0.5:12.5]
set xtics 1
set xzeroaxis lw 1 lc rgb "#333333"
set key outside top center maxcols 1
plot data using "fold":(100 * column("damped")) with linespoints lw 2 pt 7 ps 0.6 lc rgb "#d55e00" title "damped (the paper's)", \
     data using "fold":(100 * column("smooth")) with linespoints lw 2 pt 5 ps 0.6 lc rgb "#009e73" title "smooth", \
     data using "fold":(100 * column("even")) with linespoints lw 2 pt 9 ps 0.8 lc rgb "#0072b2" title "even"
)gp";

}  // namespace

Figure fold_figure() {
    Figure figure{.name = "fold_lengths",
                  .title = "Lengths, fold by fold",
                  .table = Table({"fold", "damped", "smooth", "even"}),
                  .summary = Table({"profile", "rms", "worst", "folds", "angle_degrees", "length_in_radii"})};
    std::vector<std::vector<double>> columns;
    for (const auto& [name, profile] : profiles) {
        const std::vector<double>& own = columns.emplace_back(changes(profile));
        figure.summary->add({std::string(name), rms(own), worst(own), double{folds},
                             angle * 180 / std::numbers::pi, base_length / base_radius});
    }
    for (std::size_t fold = 0; fold < folds; ++fold)
        figure.table.add(
            {static_cast<double>(fold + 1), columns[0][fold], columns[1][fold], columns[2][fold]});

    const Table& s = *figure.summary;
    const auto both = [&](std::size_t row) {
        return html(s, row, "rms", Shown::percent) + " (root mean square; worst " +
               html(s, row, "worst", Shown::change) + ")";
    };
    figure.paragraphs.push_back(
        "Every profile keeps the length of a column as a whole. This is how long each of the " +
        html(s, 0, "folds", Shown::whole) +
        " folds of the innermost column is, in the closed form in double, on a cylinder of " +
        html(s, 0, "length_in_radii", Shown::whole) + " radii that is bent by " +
        html(s, 0, "angle_degrees") +
        " degrees. A circular arc squeezes every height alike, but the paper&rsquo;s damped oscillation "
        "piles its folds up at mid-length: "
        "they are off by " +
        both(0) + ", those of the smooth profile by " + both(1) +
        ". Even folds, goffer&rsquo;s default, are off by " + both(2) + ".");
    figure.script = folds_script;
    return figure;
}

}  // namespace goffer::cli
