// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>

/// `goffer bend --path`: a body on a path.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

TEST_CASE("bend: a body lies on its path, and the report says how closely") {
    const Folder folder;
    base(folder, "base.ply", {"--caps", "--rows", "201"});
    folder.write("line.txt", "1 2 3\n11 2 3\n");
    const json line = report(folder, {"bend", "base.ply", "-o", "line.ply", "--path", "line.txt"});
    CHECK(line["path"]["error"].get<double>() < 1e-6);
    CHECK(line["path"]["clamped"] == false);
    CHECK(line["regions"].size() == 8);
    const glm::vec3 tip = mesh::load(folder / "line.ply").positions.back();
    CHECK(glm::length(tip - glm::vec3(11, 2, 3)) < 1e-5);
    // A quarter of a circle of radius 12 about the origin, said by its Bezier curve.
    folder.write("arc.json", R"({"bezier": [[[12,0,0],[12,6.6274,0],[6.6274,12,0],[0,12,0]]]})");
    const json arc = report(folder, {"bend", "base.ply", "-o", "arc.ply", "--path", "arc.json"});
    CHECK(arc["path"]["length"].get<double>() == doctest::Approx(6 * std::acos(-1.0)).epsilon(1e-3));
    CHECK(arc["path"]["error"].get<double>() < 0.05);
    CHECK(std::abs(glm::length(mesh::load(folder / "arc.ply").positions.back()) - 12) < 0.06);
    const json fitted =
        report(folder, {"bend", "base.ply", "-o", "arc.ply", "--path", "arc.json", "--path-scale", "fit"});
    CHECK(fitted["path"]["length"].get<double>() == doctest::Approx(10));
    folder.write("hook.txt", "0 0 0\n0 0 3\n0.1 0 3\n0.1 0 0\n");
    CHECK(report(folder, {"bend", "base.ply", "-o", "hook.ply", "--path", "hook.txt"})["path"]["clamped"] ==
          true);
}

TEST_CASE("bend: a path that is too short for the body is said to be, with the scale that mends it") {
    const Folder folder;
    base(folder);
    folder.write("short.txt", "0 0 0\n0 0 4\n");
    const Words words{"bend", "base.ply", "-o", "laid.ply", "--path", "short.txt"};
    const Result result = run(folder, words);
    CHECK(result.code == 0);
    CHECK(result.err.find("6 shorter than the body") != std::string::npos);
    CHECK(result.err.find("--path-scale 2.5 ") != std::string::npos);
    CHECK(run(folder, words + Words{"--path-scale", "2.5"}).err.empty());
    CHECK(run(folder, words + Words{"--path-scale", "2.5", "--path-start", "1"}).err.find("1 shorter") !=
          std::string::npos);
    folder.write("short.txt", "0 0 0\n0 0 4e-9\n");  // 2.5e9 would be more than the option takes
    CHECK(run(folder, words).err.find("give a longer one") != std::string::npos);
}

TEST_CASE("bend: a path that is many times as long as the body") {
    const Folder folder;
    base(folder);
    folder.write("far.txt", "0 0 0\n0 0 10\n0 4 20\n");
    const auto said = [&](const char* scale) {
        const Result result =
            run(folder, {"bend", "base.ply", "-o", "out.ply", "--path", "far.txt", "--path-scale", scale});
        CHECK(result.code == 0);
        return result.out.find("times as long as the body") != std::string::npos;
    };
    CHECK_FALSE(said("fit"));
    CHECK_FALSE(said("3"));
    CHECK(said("20"));
}

TEST_CASE("bend: a closed path that is made as long as the body has room for it, however many its points") {
    const Folder folder;
    base(folder);
    for (int count = 3; count <= 20; ++count) {
        CAPTURE(count);
        json points;
        for (int i = 0; i < count; ++i) {
            const double turn = 2 * std::acos(-1.0) * i / count;
            points.push_back({7 * std::cos(turn), 3 * std::sin(turn), 0});
        }
        folder.write("round.json", json{{"points", points}, {"closed", true}}.dump());
        const json laid = report(folder, {"bend", "base.ply", "--path", "round.json", "--path-scale", "fit"});
        CHECK(laid["path"]["length"].get<double>() == doctest::Approx(10));
    }
}

TEST_CASE("bend: on a path, nothing is said of angles that nobody gave") {
    const Folder folder;
    base(folder);
    well(folder, {"bend", "base.ply", "--angle", "70", "--amplitude", "none", "-o", "bent.ply"});
    folder.write("line.txt", "0 0 0\n3 7 10\n");
    const Result result = run(folder, {"bend", "bent.ply", "-o", "out.ply", "--path", "line.txt"});
    CHECK(result.out.find("this straightens 8 of 8 regions") != std::string::npos);
    CHECK(result.out.find("--by") == std::string::npos);
    CHECK(result.out.find("are absolute") == std::string::npos);
    // Rounding reads as 0.
    const Result straight = run(folder, {"bend", "base.ply", "-o", "out.ply", "--path", "line.txt"});
    CHECK(straight.out.find("the center line is within 0 of it") != std::string::npos);
    CHECK(straight.out.find("region 8: 0 degrees toward ") != std::string::npos);
}
