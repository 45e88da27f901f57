// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <string>

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

mesh::Mesh bent_mesh(const Folder& folder, const Words& words) {
    well(folder, Words{"bend", "base.ply", "-o", "out.ply"} + words);
    return mesh::load(folder / "out.ply");
}

}  // namespace

TEST_CASE("bend: regions report themselves, one by one") {
    const Folder folder;
    const json all = report(folder, {"bend", base(folder), "-o", "out.glb", "--regions", "0.3,0.4,0.3",
                                     "--angles", "40,-60,20", "--directions", "0,0,90", "--folds", "3,5,2"});
    REQUIRE(all["poses"].size() == 3);
    REQUIRE(all["regions"].size() == 3);
    CHECK(all["poses"][1]["angle"] == -60.0);
    CHECK(all["poses"][2]["direction"] == 90.0);
    CHECK(all["regions"][0]["length"].get<double>() == doctest::Approx(3));
    CHECK(all["regions"][1]["folds"] == 5);
    CHECK(all["clamped"] == false);
}

TEST_CASE("bend: regions of one curvature and direction are one bend, if nothing wrinkles") {
    const Folder folder;
    base(folder);
    const mesh::Mesh one = bent_mesh(folder, {"--angle", "80", "--folds", "0"});
    const mesh::Mesh spread =
        bent_mesh(folder, {"--angle", "80", "--folds", "0", "--regions", "0.25,0.5,0.25"});
    const mesh::Mesh said =
        bent_mesh(folder, {"--angles", "20,40,20", "--folds", "0", "--regions", "0.25,0.5,0.25"});
    CHECK(farthest(one, spread) < 4e-6);
    CHECK(farthest(one, said) < 4e-6);
}

TEST_CASE("bend: an S comes back to the direction that it began in") {
    const Folder folder;
    base(folder, "base.ply", {"--caps"});
    const mesh::Mesh s = bent_mesh(folder, {"--regions", "0.5,0.5", "--angles", "60,-60", "--folds", "0"});
    // The tip's center is the last vertex; each region moves it by the same step.
    const double alpha = std::acos(-1.0) / 3, kappa = alpha / 5;
    const double x = (1 - kappa) * 5 * (1 - std::cos(alpha)) / alpha;
    const double z = (1 - kappa) * 5 * std::sin(alpha) / alpha;
    const glm::vec3 tip = s.positions.back();
    CHECK(std::abs(tip.x - 2 * x) < 1e-5);
    CHECK(std::abs(tip.z - 2 * z) < 1e-5);
}

TEST_CASE("bend: a region beyond its largest angle is clamped, and named") {
    const Folder folder;
    const json all =
        report(folder, {"bend", base(folder), "-o", "out.ply", "--regions", "0.5,0.5", "--angles", "10,900"});
    CHECK(all["clamped"] == true);
    CHECK(all["regions"][0]["clamped"] == false);
    CHECK(all["regions"][1]["clamped"] == true);
    bool named = false;
    for (const json& warning : all["warnings"])
        named = named || warning.get<std::string>().starts_with("region 2: the angle of 900 degrees");
    CHECK(named);
}

TEST_CASE("bad regions: wrong usage, one line, and nothing written") {
    const Folder folder;
    base(folder);
    struct Bad {
        Words words;
        std::string said;
    };
    std::string many = "0.03";
    for (int i = 0; i < 32; ++i) many += ",0.03";
    for (const Bad& bad : {
             Bad{{"--regions", "0.3,0.3"}, "add up to 0.6"},
             Bad{{"--regions", "0.5,0,0.5"}, "must be above 0"},
             Bad{{"--regions", "0.5,x"}, "'x'"},
             Bad{{"--regions", "0.5,,0.5"}, "''"},
             Bad{{"--regions", many}, "33 of them"},
             Bad{{"--regions", "0.5,0.5", "--angles", "1,2,3"}, "--angles: 3 for 2 regions"},
             Bad{{"--regions", "0.5,0.5", "--directions", "1"}, "--directions: 1 for 2 regions"},
             Bad{{"--regions", "0.5,0.5", "--folds", "1,2,3"}, "--folds: 3 for 2 regions"},
             Bad{{"--regions", "0.33,0.33,0.33"}, "add up to 0.99"},
             Bad{{"--folds", "5", "--fold-length", "1"}, "--fold-length"},
             Bad{{"--folds", "1,2"}, "--folds: a list is for a body of several regions; add --regions"},
             Bad{{"--folds", "2.5"}, "whole number"},
             Bad{{"--folds", "513"}, "0..512"},
             Bad{{"--regions", "0.5,0.5", "--angles", "1,most"}, "'most'"},
             Bad{{"--angles", "10"}, "--regions"},
             Bad{{"--onset", "2"}, "a squeeze"},
         }) {
        CAPTURE(bad.said);
        refused(folder, 2, Words{"bend", "base.ply", "-o", "new.ply"} + bad.words, {bad.said});
    }
}

TEST_CASE("bend: amplitude mesh keeps the mesh's own area, and an onset costs some") {
    const Folder folder;
    base(folder);
    const auto change = [&](const Words& words) {
        const json all = report(folder, Words{"bend", "base.ply", "-o", "out.ply", "--angle", "100"} + words);
        return std::abs(all["area_after"].get<double>() / all["area_before"].get<double>() - 1);
    };
    const Words damped{"--profile", "damped", "--shape", "cylinder"};
    const double plain = change({"--paper"}), mesh = change(damped + Words{"--amplitude", "mesh"});
    CHECK(plain > 1e-3);
    CHECK(mesh < 1e-6);
    CHECK(change({}) < 2e-6);
    const double gentle = change({"--paper", "--onset", "0.05"});
    CHECK(gentle > plain);
    CHECK(gentle < 0.05);
}

TEST_CASE("bend: folds run on over joints, so that equal bends are one, or end at them") {
    const Folder folder;
    base(folder);
    const Words parts{"--regions", "0.5,0.5", "--angles", "40,40", "--folds", "6,6", "--amplitude", "paper"};
    const mesh::Mesh one = bent_mesh(folder, {"--angle", "80", "--folds", "12", "--amplitude", "paper"});
    const mesh::Mesh over = bent_mesh(folder, parts);
    const mesh::Mesh apart = bent_mesh(folder, parts + Words{"--joints", "apart"});
    CHECK(farthest(one, over) < 2e-5);
    CHECK(farthest(one, apart) > 0.05);
    refused(folder, 2, {"bend", "base.ply", "-o", "x.ply", "--joints", "half"}, {"--joints"});
}

TEST_CASE("bend: more than a full turn is said to go through itself") {
    const Folder folder;
    base(folder, "base.ply", {"--length", "30"});
    const auto beyond = [&](const Words& words) {
        return report(folder, Words{"bend", "base.ply", "-o", "out.ply"} + words)["beyond_full_turn"]
            .get<bool>();
    };
    CHECK(beyond({"--angle", "365"}));
    CHECK_FALSE(beyond({"--angle", "355"}));
    CHECK(beyond({"--regions", "0.5,0.5", "--angles", "200,190"}));
    CHECK_FALSE(beyond({"--regions", "0.5,0.5", "--angles", "200,-190"}));
}

TEST_CASE("bend: a body that runs through itself is said to, though it bends by less than a full turn") {
    const Folder folder;
    base(folder, "base.ply", {"--length", "60"});  // radii
    const auto warnings = [&](const std::string& angles) {
        const json said = report(
            folder, {"bend", "base.ply", "-o", "out.ply", "--regions", "0.4,0.2,0.4", "--angles", angles});
        CHECK(said["runs_through_itself"].get<bool>() == !said["warnings"].empty());
        return said["warnings"].dump();
    };
    CHECK(warnings("0,180,0") == "[]");  // legs lie side by side
    CHECK(warnings("0,250,0").find("parts of the body go through each other; bend it less") !=
          std::string::npos);
    CHECK(warnings("250,0,-250") == "[]");
}

TEST_CASE("bend: shares that are rounded make a whole") {
    const Folder folder;
    base(folder);
    const mesh::Mesh thirds = bent_mesh(folder, {"--regions", "0.333,0.333,0.333", "--angles", "60,0,-30"});
    const mesh::Mesh equal =
        bent_mesh(folder, {"--regions", "0.3333333,0.3333333,0.3333334", "--angles", "60,0,-30"});
    CHECK(farthest(thirds, equal) < 1e-5);
    well(folder,
         {"bend", "base.ply", "--regions", "0.167,0.167,0.167,0.167,0.167,0.167", "-o", "sixths.ply"});
}
