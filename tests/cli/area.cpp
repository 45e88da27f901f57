// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/models.hpp"
#include "support/rounds.hpp"
#include "support/worst.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

/// The figures of the method (area and column lengths of a bent base cylinder of L = 10, r = 1), taken from
/// the files that the command writes, and the areas of real models.

using namespace goffer;
using namespace goffer::test;

namespace {

const Words paper{"--paper"};

/// As --paper, but for the depth of wrinkles.
Words damped(const char* amplitude) {
    return {"--profile", "damped", "--shape", "cylinder", "--onset", "0", "--amplitude", amplitude};
}

constexpr std::array<int, 3> angles{30, 90, 180};

/// The angles that are tried, by their places: all, or the one in the middle.
const std::size_t first_angle = rounds<std::size_t>(0, 1), last_angle = rounds<std::size_t>(angles.size(), 2);

/// A base cylinder of so many columns and 2 k steps + 1 rows, and what bending does to it.
class Cylinder {
public:
    Cylinder(int columns, int folds, int steps)
        : columns_(static_cast<std::size_t>(columns)),
          rows_(static_cast<std::size_t>(2 * std::max(folds, 1) * steps + 1)),
          folds_(folds) {
        base(folder_, "base.ply", {"--columns", std::to_string(columns_), "--rows", std::to_string(rows_)});
    }

    /// Change of the mesh's area, as a fraction. The bent mesh stays in the folder.
    [[nodiscard]] double area_change(int angle, const Words& words = paper) const {
        const auto all =
            report(folder_, Words{"bend", "base.ply", "-o", "bent.ply", "--refine", "off", "--angle",
                                  std::to_string(angle), "--folds", std::to_string(folds_)} +
                                words);
        CHECK(all["clamped"] == false);
        return all["area_after"].get<double>() / all["area_before"].get<double>() - 1;
    }

    /// Lengths of the bent mesh's columns over L.
    [[nodiscard]] std::vector<double> column_lengths() const {
        const mesh::Mesh mesh = mesh::load(folder_ / "bent.ply");
        REQUIRE(mesh.positions.size() == rows_ * columns_);
        std::vector<double> lengths(columns_);
        for (std::size_t i = columns_; i < mesh.positions.size(); ++i)
            lengths[i % columns_] +=
                glm::length(glm::dvec3(mesh.positions[i]) - glm::dvec3(mesh.positions[i - columns_])) /
                base_length;
        return lengths;
    }

private:
    Folder folder_;
    std::size_t columns_;
    std::size_t rows_;
    int folds_;
};

/// One column of the table of known values in per cent, met to the last digit but one.
void check_table(int folds, const std::array<double, 3>& known) {
    const Cylinder cylinder(256, folds, 128);
    for (std::size_t i = first_angle; i < last_angle; ++i) {
        const double change = 100 * cylinder.area_change(angles[i]);
        std::printf("area, k = %2d, %3d degrees: %+.4f %% (known %+.3f)\n", folds, angles[i], change,
                    known[i]);
        CHECK(std::abs(change - known[i]) < 0.005);
    }
}

/// A model, straightened, refined and bent by 30 and by 60 degrees. Its own area changes by as many per cent
/// as are known of the method's amplitude, and with `--amplitude mesh` by none, with the paper's wrinkles or
/// without a word about them.
void check_area_of_model(const char* name, const std::array<double, 2>& known) {
    const std::filesystem::path file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const auto change = [&](const char* angle, const Words& words) {
        const auto all = report(folder, Words{"bend", file.string(), "-o", name, "--rest", "straight",
                                              "--refine", "on", "--angle", angle} +
                                            words);
        return 100 * (all["area_after"].get<double>() / all["area_before"].get<double>() - 1);
    };
    const char* const degrees[] = {"30", "60"};
    for (std::size_t i = 0; i < 2; ++i) {
        CAPTURE(degrees[i]);
        CHECK(std::abs(change(degrees[i], paper) - known[i]) < 1e-3);
        CHECK(std::abs(change(degrees[i], damped("mesh"))) < 1.5e-3);
        CHECK(std::abs(change(degrees[i], {})) < 5e-3);
    }
}

}  // namespace

TEST_CASE("area: the bare bend loses kappa") {
    check_table(0, {-5.236, -15.708, -31.416});
}

TEST_CASE("area: known values, 3 folds") {
    check_table(3, {0.096, 0.253, 0.520});
}

TEST_CASE("area: known values, 6 folds") {
    check_table(6, {0.018, 0.042, 0.076});
}

TEST_CASE("area: known values, 10 folds") {
    check_table(10, {0.004, 0.009, 0.015});
}

TEST_CASE("area: amplitude area keeps it, as the grid grows finer") {
    for (const int folds : {3, 6}) {
        const Cylinder coarse(128, folds, 64), fine(256, folds, 128);
        for (std::size_t i = first_angle; i < last_angle; ++i) {
            const int angle = angles[i];
            const double limit =
                (4 * fine.area_change(angle, damped("area")) - coarse.area_change(angle, damped("area"))) / 3;
            std::printf("area kept, k = %2d, %3d degrees: within %.1e\n", folds, angle, std::abs(limit));
            CHECK(std::abs(limit) < 2e-6);
        }
    }
}

TEST_CASE("columns: of the bare bend as long as eq 9 and 10 say, the outer one as before") {
    const Cylinder cylinder(64, 0, 256);
    (void)cylinder.area_change(90);
    const std::vector<double> lengths = cylinder.column_lengths();
    const double kappa = std::numbers::pi / 2 / base_length;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double squeeze = kappa * (1 + std::cos(2 * std::numbers::pi * static_cast<double>(i) / 64));
        CHECK(std::abs(lengths[i] - (1 - squeeze)) < 1e-6);
    }
    CHECK(std::abs(lengths[32] - 1) < 1e-6);
}

TEST_CASE("columns: of the wrinkled base keep their lengths (P3)") {
    for (const int folds : {6, 10}) {
        const Cylinder cylinder(48, folds, 256);
        for (std::size_t i = first_angle; i < last_angle; ++i) {
            const int angle = angles[i];
            (void)cylinder.area_change(angle);
            double worst = 0;
            for (const double l : cylinder.column_lengths()) test::take_worst(worst, std::abs(l - 1));
            std::printf("columns, k = %2d, %3d degrees: within %.4f %%\n", folds, angle, 100 * worst);
            CHECK(worst < 1e-3);
        }
    }
}

TEST_CASE("area: wine_bottle.glb") {
    check_area_of_model("wine_bottle.glb", {0.3596, 0.7427});
}

TEST_CASE("area: log_01.glb") {
    check_area_of_model("log_01.glb", {-0.2297, -0.409});
}

TEST_CASE("area: insect_leg.glb") {
    check_area_of_model("insect_leg.glb", {-1.7391, -3.4923});
}

TEST_CASE("area: fuze.ply") {
    check_area_of_model("fuze.ply", {-0.1138, -0.0398});
}

TEST_CASE("area: blub_open.obj") {
    check_area_of_model("blub_open.obj", {-3.5213, -6.1285});
}
