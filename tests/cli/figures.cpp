// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "pixels.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace goffer;
using namespace goffer::test;

namespace {

const std::string bottle = GOFFER_SOURCE_DIR "/tests/data/wine_bottle.glb";

/// Charts are looked at where there is something to draw them.
bool has_gnuplot() {
    return std::system("command -v gnuplot >/dev/null") == 0;
}

Words quick(const Words& models, const std::string& folder, const Words& more = {}) {
    return Words{"figures"} + models + Words{"-o", folder, "--quick", "--size", "160x120"} +
           (has_gnuplot() ? Words{} : Words{"--no-charts"}) + more;
}

/// A CSV file: text of every cell, by its row and its column's name.
struct Csv {
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;

    explicit Csv(const std::string& text) {
        std::vector<std::string> cells(1);
        bool quoted = false;
        for (const char c : text) {
            if (c == '"') {
                quoted = !quoted;
            } else if (c == ',' && !quoted) {
                cells.emplace_back();
            } else if (c == '\n' && !quoted) {
                take(cells);
                cells.assign(1, "");
            } else {
                cells.back() += c;
            }
        }
        CHECK(cells == std::vector<std::string>(1));  // the last line has an end
        CHECK(!rows.empty());
    }

    [[nodiscard]] double at(std::size_t row, const std::string& name) const {
        CAPTURE(name);
        REQUIRE(row < rows.size());
        REQUIRE(rows[row].contains(name));
        return std::stod(rows[row].at(name));
    }
    [[nodiscard]] std::vector<double> column(const std::string& name) const {
        std::vector<double> values;
        for (std::size_t row = 0; row < rows.size(); ++row) values.push_back(at(row, name));
        return values;
    }

private:
    void take(const std::vector<std::string>& cells) {
        if (names.empty()) {
            names = cells;
            return;
        }
        REQUIRE(cells.size() == names.size());
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
    }
};

Csv csv(const Folder& folder, const std::string& name) {
    CAPTURE(name);
    return Csv(bytes_of(folder / name));
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// Numbers of the page are shown as `value` says, rounded, and that is a cell of the section's files.
void check_numbers(const Folder& folder, const std::string& page) {
    static const std::regex sections("<section id=\"([a-z0-9_]+)\">([^]*?)</section>");
    static const std::regex numbers("<data value=\"([^\"]*)\">([^<&]*)(&nbsp;%)?</data>");
    std::size_t count = 0;
    for (const std::smatch& section : matches(page, sections)) {
        const std::string name = section[1], text = section[2];
        CAPTURE(name);
        std::set<std::string> cells;
        for (const std::string ending : {".csv", "_summary.csv"}) {
            if (!std::filesystem::exists(folder / ("page/" + name + ending))) continue;
            for (const auto& row : csv(folder, "page/" + name + ending).rows)
                for (const auto& [column, cell] : row) cells.insert(cell);
        }
        for (const std::smatch& number : matches(text, numbers)) {
            const std::string value = number[1];
            std::string shown = number[2];
            std::erase(shown, ',');  // 10,000
            CAPTURE(value);
            CAPTURE(shown);
            CHECK(cells.contains(value));
            const double exact = std::stod(value) * (number[3].matched ? 100 : 1);
            CHECK(std::fabs(std::stod(shown) - exact) <= std::max(0.0051 * std::fabs(exact), 0.0051));
            ++count;
        }
    }
    CHECK(count > 300);
}

/// Everything that the page names is there, and nothing else.
void check_links(const Folder& folder, const std::string& page) {
    static const std::regex links("(?:href|src)=\"([^\"]*)\"");
    std::set<std::string> named{"index.html"};
    for (const std::smatch& link : matches(page, links)) named.insert(link[1]);
    std::set<std::string> there;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "page"))
        there.insert(entry.path().filename().string());
    CHECK(named == there);
    CHECK(page.find("<script") == page.npos);
    std::size_t pictures = 0;
    for (const std::string& name : there) {
        const std::filesystem::path file = folder / ("page/" + name);
        if (name.ends_with(".svg")) CHECK(bytes_of(file).find("</svg>") != std::string::npos);
        if (!name.ends_with(".png")) continue;
        const Pixels pixels(file);
        CHECK(pixels.width == 160);
        CHECK(pixels.height == 120);
        ++pictures;
    }
    CHECK(pictures == 6);
    CHECK(there.contains("area.svg") == has_gnuplot());
}

/// L = 10, r = 1, bent by 90 degrees.
void check_base_grid(const Folder& folder) {
    constexpr double kappa = std::numbers::pi / 2 / 10;
    const Csv bare = csv(folder, "page/figure_5.csv"), wrinkled = csv(folder, "page/figure_6.csv");
    CHECK(bare.at(0, "angle_degrees") == 90);
    CHECK(bare.at(0, "closed_form_area_factor") == doctest::Approx(1 - kappa).epsilon(1e-8));
    CHECK(bare.at(0, "area_factor") == doctest::Approx(1 - kappa).epsilon(1e-5));
    CHECK(bare.at(0, "inner_column_factor") == doctest::Approx(1 - 2 * kappa).epsilon(1e-5));
    CHECK(bare.at(0, "wrinkle_depth") == 0);
    const double area = paper::lateral_area(paper::Profile::damped, 5, 10, 1, std::numbers::pi / 2, 1);
    CHECK(wrinkled.at(0, "folds_per_half_length") == 5);
    CHECK(wrinkled.at(0, "closed_form_area_factor") == doctest::Approx(area).epsilon(1e-8));
    // 32 rows to a fold leave it short by a two-thousandth.
    CHECK(std::fabs(wrinkled.at(0, "area_factor") - area) < 1e-3);
    CHECK(std::fabs(wrinkled.at(0, "inner_column_factor") - 1) < 1e-3);
    const double depth = paper::amplitude(paper::Profile::damped, 5, 10, 2 * kappa);
    CHECK(wrinkled.at(0, "wrinkle_depth") == doctest::Approx(depth).epsilon(0.15));  // near mid-height
}

/// Length of a fold of the inner column over that at rest: polar coordinates about the arc's center.
double fold_length(paper::Profile profile, int fold) {
    constexpr double length = 10, radius = 1, alpha = std::numbers::pi / 2;
    constexpr int all = 12, steps = 4000;
    const int folds = profile == paper::Profile::even ? all : all / 2;
    const double amplitude = paper::amplitude(profile, folds, length, 2 * alpha * radius / length);
    const auto distance = [&](double z) {
        const double u = std::fabs(2 * z / length - 1);
        return length / alpha - 2 * radius - amplitude * paper::shape(profile, folds, u);
    };
    double sum = 0;
    for (int step = 0; step < steps; ++step) {
        const double z = length * (fold + (step + 0.5) / steps) / all, half = length / all / steps / 2;
        const double low = distance(z - half), high = distance(z + half);
        sum += std::hypot(high - low, (low + high) / 2 * alpha / length * 2 * half);
    }
    return sum / (length / all);
}

void check_folds(const Folder& folder) {
    const Csv table = csv(folder, "page/fold_lengths.csv"),
              summary = csv(folder, "page/fold_lengths_summary.csv");
    REQUIRE(table.rows.size() == 12);
    constexpr std::array profiles{std::pair("damped", paper::Profile::damped),
                                  std::pair("smooth", paper::Profile::smooth),
                                  std::pair("even", paper::Profile::even)};
    for (std::size_t p = 0; p < profiles.size(); ++p) {
        const std::string name = profiles[p].first;
        const paper::Profile profile = profiles[p].second;
        CAPTURE(name);
        double squares = 0, worst = 0;
        for (int fold = 0; fold < 12; ++fold) {
            const double change = fold_length(profile, fold) - 1;
            CHECK(table.at(static_cast<std::size_t>(fold), name) == doctest::Approx(change).epsilon(1e-4));
            squares += change * change;
            if (std::fabs(change) > std::fabs(worst)) worst = change;
        }
        CHECK(summary.rows[p].at("profile") == name);
        CHECK(summary.at(p, "rms") == doctest::Approx(std::sqrt(squares / 12)).epsilon(1e-4));
        CHECK(summary.at(p, "worst") == doctest::Approx(worst).epsilon(1e-4));
    }
}

/// The area of the base model on two bones, whose middles are at a quarter and at three quarters.
double skinned_area(const mesh::Mesh& base, double angle) {
    std::vector<glm::vec3> positions;
    for (const glm::vec3& p : base.positions) {
        const double weight = std::clamp(2 * p.z / 10.0 - 0.5, 0.0, 1.0), z = p.z - 5.0;
        const glm::dvec3 turned{std::cos(angle) * p.x + std::sin(angle) * z, p.y,
                                5 + std::cos(angle) * z - std::sin(angle) * p.x};
        positions.emplace_back((1 - weight) * glm::dvec3(p) + weight * turned);
    }
    return fit::surface_area(positions, mesh::triangles(base));
}

void check_area(const Folder& folder, const mesh::Mesh& base) {
    const Csv table = csv(folder, "page/area.csv");
    REQUIRE(table.rows.size() == 5);
    const double area = fit::surface_area(base.positions, mesh::triangles(base));
    for (std::size_t row = 0; row < 5; ++row) {
        CAPTURE(row);
        const double degrees = table.at(row, "angle_degrees"), angle = degrees * std::numbers::pi / 180;
        // The radius that is fitted to 64 sides is a little less than 1.
        CHECK(table.at(row, "bare") == doctest::Approx(-angle / 10).epsilon(2e-3));
        CHECK(std::fabs(table.at(row, "skin_few_bones") - (skinned_area(base, angle) / area - 1)) < 1e-4);
        CHECK(std::fabs(table.at(row, "amplitude_mesh")) < 2e-4);
        CHECK(std::fabs(table.at(row, "amplitude_area")) < 0.02);
        if (row == 0) continue;
        CHECK(table.at(row, "bare") < table.at(row - 1, "bare"));
        CHECK(table.at(row, "bare") < table.at(row, "skin_few_bones"));
        CHECK(table.at(row, "skin_few_bones") < table.at(row, "skin_many_bones"));
        CHECK(table.at(row, "skin_many_bones_local_rms") > table.at(row, "amplitude_mesh_local_rms"));
        CHECK(table.at(row, "skin_many_bones_local_rms") > table.at(row - 1, "skin_many_bones_local_rms"));
    }
}

/// The numbers are those of `goffer bend`.
void check_figure_of_model(const Folder& folder) {
    const Csv table = csv(folder, "page/figure_8.csv");
    REQUIRE(table.rows.size() == 2);
    for (std::size_t row = 0; row < 2; ++row) {
        const bool paper = table.rows[row].at("method") == "paper";
        CHECK(paper == (row == 0));
        const nlohmann::json bent = report(folder, Words{"bend", bottle, "--by", "60", "-o", "bent.glb"} +
                                                       (paper ? Words{"--paper"} : Words{}));
        const auto is = [&](const std::string& name, double value) {
            CAPTURE(name);
            CHECK(std::fabs(table.at(row, name) - value) < 1e-7 * std::max(1.0, std::fabs(value)));
        };
        is("angle_degrees", 60);
        is("area_change", bent["area_after"].get<double>() / bent["area_before"].get<double>() - 1);
        is("local_rms", bent["local_area_change"]["bent"]["rms"]);
        is("local_worst", bent["local_area_change"]["bent"]["worst"]);
        is("bare_local_rms", bent["local_area_change"]["without_wrinkles"]["rms"]);
        is("largest_angle_degrees", bent["max_angle"]);
        is("folds", bent["folds"]);
        is("vertices", bent["vertices"]);
        if (paper) is("base_area_change", bent["base_area_change"]);
    }
}

void check_times(const Folder& folder, const std::string& page) {
    const Csv table = csv(folder, "page/figure_9.csv"), all = csv(folder, "page/figure_9_summary.csv");
    std::set<std::string> steps;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string step = table.rows[row].at("method") + ": " + table.rows[row].at("step");
        CAPTURE(step);
        steps.insert(step);
        CHECK(table.at(row, "vertices") == 10000);
        CHECK(table.at(row, "fastest") <= table.at(row, "milliseconds"));
        CHECK(table.at(row, "milliseconds") <= table.at(row, "slowest"));
    }
    for (const char* const step :
         {"step by step: base deformation", "step by step: wrinkle", "step by step: merge",
          "goffer: base and merge", "goffer: wrinkle", "goffer: normals"})
        CHECK(steps.contains(step));
    const bool drawn = page.find("There is no bar for drawing") == page.npos;
    CHECK(steps.contains("goffer: drawing") == drawn);
    CHECK(steps.contains("step by step: drawing") == drawn);
    // Medians of sums are about the sums of medians.
    const auto total = [&](std::size_t first) {
        return table.at(first, "milliseconds") + table.at(first + 1, "milliseconds");
    };
    const double steps_total = total(0) + table.at(2, "milliseconds"), kernel_total = total(drawn ? 4 : 3);
    CHECK(std::fabs(all.at(0, "milliseconds") / steps_total - 1) < 0.4);
    CHECK(std::fabs(all.at(1, "milliseconds") / kernel_total - 1) < 0.4);
    CHECK(all.at(1, "times_as_fast") ==
          doctest::Approx(all.at(0, "milliseconds") / all.at(1, "milliseconds")).epsilon(1e-6));
    for (const std::string name : {"vertices", "instances"}) {
        const Csv costs = csv(folder, "page/" + name + ".csv");
        for (const std::string column : {"one_thread_ns", "all_threads_ns", "fill_ns"})
            CHECK(std::ranges::min(costs.column(column)) > 0);
        CHECK(std::ranges::max(costs.column(name)) == (name == "vertices" ? 10'000 : 100));
    }
}

}  // namespace

TEST_CASE("figures: a page of two models, its data, its pictures and its charts") {
    const Folder folder;
    base(folder);
    const nlohmann::json made = report(folder, quick({"base.ply", bottle}, "page"));
    CHECK(made["quick"] == true);
    CHECK(made["figures"].size() == 9);
    const std::string page = bytes_of(folder / "page/index.html");
    CHECK(page.find("Made with --quick") != page.npos);
    check_numbers(folder, page);
    check_links(folder, page);
    check_base_grid(folder);
    check_folds(folder);
    check_area(folder, mesh::load(folder / "base.ply"));
    check_figure_of_model(folder);
    check_times(folder, page);

    // The report has what the files have.
    for (const nlohmann::json& figure : made["figures"]) {
        const Csv table = csv(folder, "page/" + figure["name"].get<std::string>() + ".csv");
        CHECK(table.names == figure["table"]["columns"].get<std::vector<std::string>>());
        CHECK(table.rows.size() == figure["table"]["rows"].size());
        for (const nlohmann::json& file : figure["files"])
            CHECK(std::filesystem::exists(folder / ("page/" + file.get<std::string>())));
    }

    // What is no time is the same again, in the same folder, whatever the threads; users can draw charts
    // again.
    const Snapshot before = snapshot(folder);
    well(folder, quick({"base.ply", bottle}, "page/", {"--threads", "1"}));
    for (const std::string name :
         {"figure_5_90.png", "figure_8_goffer_60.png", "figure_5.csv", "figure_6.csv", "figure_7.csv",
          "figure_8.csv", "area.csv", "fold_lengths.csv"}) {
        CAPTURE(name);
        CHECK(before.at((folder / "./page/").string() + name).first == bytes_of(folder / ("page/" + name)));
    }
    if (!has_gnuplot()) {
        MESSAGE("skipped: without gnuplot there are no charts");
        return;
    }
    for (const std::string name : {"figure_9", "fold_lengths", "area", "vertices", "instances"}) {
        const std::filesystem::path chart = folder / ("page/" + name + ".svg");
        const std::string drawn = bytes_of(chart);
        std::filesystem::remove(chart);
        const std::string again = "cd '" + (folder / "page").string() + "' && gnuplot " + name + ".gp";
        CHECK(std::system(again.c_str()) == 0);
        CHECK(bytes_of(chart) == drawn);
    }
}

TEST_CASE("figures: a body that is bent at rest, without charts") {
    const Folder folder;
    const std::string leg = GOFFER_SOURCE_DIR "/tests/data/insect_leg.glb";
    well(folder, quick({leg}, "a/page") + Words(has_gnuplot() ? 1 : 0, "--no-charts"));
    CHECK(bytes_of(folder / "a/page/index.html").find("gnuplot area.gp") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "a/page/area.svg"));
    CHECK(std::filesystem::exists(folder / "a/page/area.gp"));
    const Csv area = csv(folder, "a/page/area.csv");
    for (std::size_t row = 0; row < area.rows.size(); ++row) {
        CHECK(area.rows[row].at("amplitude_area").empty());
        // All count from the rest pose.
        if (row == 0) CHECK(std::fabs(area.at(row, "skin_many_bones")) < 1e-6);
        if (row == 0) CHECK(std::fabs(area.at(row, "bare")) < 1e-6);
        // Bones lie along the rest arc: what the inner side loses, the outer one gains, but for some.
        if (row > 0)
            CHECK(std::fabs(area.at(row, "skin_many_bones")) < 0.5 * std::fabs(area.at(row, "bare")));
    }
}

TEST_CASE("figures: what is refused, with nothing written") {
    const Folder folder;
    base(folder);
    const Words page = Words{"-o", "page", "--quick", "--no-charts"};
    refused(folder, 2, {"figures", "-o", "page"}, {"model"});
    refused(folder, 2, {"figures", "base.ply"}, {"--output is required"});
    refused(folder, 2, Words{"figures"} + Words(9, "base.ply") + page, {"figures"});
    refused(folder, 2, Words{"figures", "base.ply", "--size", "10"} + page, {"--size: '10' is not a size"});
    refused(folder, 2, Words{"figures", "base.ply", "--json", "base.ply"} + page,
            {"--json", "base.ply", "MODEL"});
    refused(folder, 2, Words{"figures", "base.ply", "--json", "page/index.html"} + page, {"--json", "-o"});
    refused(folder, 1, Words{"figures", "none.ply"} + page, {"none.ply"});
    refused(folder, 1, {"figures", "base.ply", "-o", "base.ply", "--no-charts"},
            {"base.ply", "is not a folder"});
    refused(folder, 1, {"figures", "base.ply", "-o", ".", "--no-charts"},
            {"has files", "a new folder to -o"});
    refused(folder, 1, {"figures", "base.ply", "-o", "base.ply/x", "--no-charts"}, {"base.ply/x"});
    well(folder, {"bake", "base.ply", "-o", "base.goffer"});
    refused(folder, 1, Words{"figures", "base.goffer"} + page, {"base.goffer"});
    std::filesystem::create_directory(folder / "pipe");
    REQUIRE(mkfifo((folder / "pipe/index.html").c_str(), 0600) == 0);
    refused(folder, 1, {"figures", "base.ply", "-o", "pipe", "--quick", "--no-charts"}, {"has files"});

    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    refused(folder, 1, {"figures", "base.ply", "-o", "page", "--quick"},
            {"gnuplot cannot be run", "gnuplot-nox", "--no-charts"});
    setenv("PATH", path.c_str(), 1);
}
