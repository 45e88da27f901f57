// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/bent_pipe.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

/// Models that are bent along a chain of arcs.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// A bent pipe in `folder`. Returns its name.
std::string pipe(const Folder& folder) {
    const BentPipe pipe;
    std::ofstream file(folder / "s.obj");
    file.precision(9);
    for (const glm::vec3& p : pipe.positions) file << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (std::size_t i = 0; i < pipe.triangles.size(); i += 3)
        file << "f " << pipe.triangles[i] + 1 << ' ' << pipe.triangles[i + 1] + 1 << ' '
             << pipe.triangles[i + 2] + 1 << '\n';
    return "s.obj";
}

/// How far the mesh reaches along x, y and z.
glm::vec3 extent(const mesh::Mesh& mesh) {
    glm::vec3 low = mesh.positions[0], high = low;
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    return high - low;
}

/// Runs a command that straightens its body, and has nothing else to warn of.
void straightened(const Folder& folder, const Words& words) {
    const Result result = run(folder, words);
    CAPTURE(result.err);
    CHECK(result.code == 0);
    CHECK(result.err.starts_with("goffer: warning: the area changes by +"));
    CHECK(std::ranges::count(result.err, '\n') == 1);
}

}  // namespace

TEST_CASE("chain: inspect finds the arcs of an S, and a region for each") {
    const Folder folder;
    const json found = report(folder, {"inspect", pipe(folder)});
    REQUIRE(found["fit"]["arcs"].size() == 2);
    for (const json& arc : found["fit"]["arcs"]) CHECK(std::abs(arc["angle"].get<double>() - 120) < 1);
    const double turn = found["fit"]["arcs"][0]["direction"].get<double>() -
                        found["fit"]["arcs"][1]["direction"].get<double>();
    CHECK(std::abs(std::abs(std::remainder(turn, 360)) - 180) < 1);
    CHECK(found["fit"]["rest_angle"] == 0);
    CHECK(found["regions"].size() == 2);
    CHECK(found["rest"]["bent"] == true);
    CHECK(found["rest"]["arc_radius"].is_null());
    const json one = report(folder, {"inspect", "s.obj", "--rest", "arc"});
    CHECK(!one["fit"].contains("arcs"));
    CHECK(one["regions"].size() == 1);
}

TEST_CASE("chain: bend leaves it as it is by 0, straightens it to 0, and shares an angle out") {
    const Folder folder;
    pipe(folder);
    well(folder, {"bend", "s.obj", "--by", "0", "-o", "same.ply", "--folds", "0"});
    CHECK(farthest(mesh::load(folder / "s.obj"), mesh::load(folder / "same.ply")) < 1e-4);

    const json straight = report(folder, {"bend", "s.obj", "--angle", "0", "-o", "straight.ply"});
    CHECK(straight["straightens"] == true);
    const glm::vec3 size = extent(mesh::load(folder / "straight.ply"));
    const float longest = std::max({size.x, size.y, size.z});
    CHECK(std::abs(longest / straight["fit"]["length"].get<float>() - 1) < 0.02f);
    CHECK(size.x + size.y + size.z < longest + 5);  // of radius 1, whichever way it lies

    const json by = report(folder, {"bend", "s.obj", "--by", "40", "-o", "by.ply"});
    REQUIRE(by["poses"].size() == 2);
    double more = 0;
    for (const json& pose : by["poses"])
        more += pose["angle"].get<double>() - pose["rest_angle"].get<double>();
    CHECK(std::abs(more) < 0.1);  // one arc gives what the other takes
    CHECK(std::abs(by["poses"][0]["angle"].get<double>() - by["poses"][0]["rest_angle"].get<double>()) ==
          doctest::Approx(20).epsilon(0.01));
}

TEST_CASE("chain: where bending an S on stretches it, a direction is named that stretches it less") {
    const Folder folder;
    const Words words{"bend", pipe(folder), "--by", "90", "-o", "out.glb"};
    const json in_plane = report(folder, words);
    REQUIRE(in_plane["warnings"].size() == 1);
    const std::string said = in_plane["warnings"][0].get<std::string>(), option = "; --direction ";
    const std::size_t at = said.find(option), end = said.find(", across that", at);
    REQUIRE(end != said.npos);
    const std::string direction = said.substr(at + option.size(), end - at - option.size());
    const json across = report(folder, words + Words{"--direction", direction});
    const auto change = [](const json& of) {
        return std::abs(of["area_after"].get<double>() / of["area_before"].get<double>() - 1);
    };
    CHECK(across["warnings"].empty());
    CHECK(change(across) < 0.3 * change(in_plane));
}

TEST_CASE("chain: what a region has no room for goes to the others") {
    const Folder folder;
    copy_of(folder, "insect_leg.glb");  // its knee hardly bends further
    const json by = report(folder, {"bend", "insect_leg.glb", "--by", "60", "-o", "out.ply", "--folds", "0"});
    CHECK(by["clamped"] == false);
    REQUIRE(by["poses"].size() > 4);
    bool full = false;
    double x = 0, y = 0;  // what all are turned by, as a vector
    for (std::size_t i = 0; i < by["poses"].size(); ++i) {
        const json& pose = by["poses"][i];
        const auto add = [&](const char* angle, const char* direction, double sign) {
            const double toward = pose[direction].get<double>() * std::numbers::pi / 180;
            x += sign * pose[angle].get<double>() * std::cos(toward);
            y += sign * pose[angle].get<double>() * std::sin(toward);
        };
        add("angle", "direction", 1);
        add("rest_angle", "rest_direction", -1);
        full = full || pose["angle"].get<double>() > by["regions"][i]["max_angle"].get<double>() - 1e-3;
    }
    CHECK(full);
    CHECK(std::hypot(x, y) == doctest::Approx(60).epsilon(0.001));
    // Where none has room, it is said.
    CHECK(report(folder, {"bend", "insect_leg.glb", "--by", "5000", "-o", "out.ply", "--folds",
                          "0"})["clamped"] == true);
}

TEST_CASE("chain: regions that are said, and a path, take the place of its arcs") {
    const Folder folder;
    pipe(folder);
    const json said = report(folder, {"bend", "s.obj", "-o", "out.ply", "--regions", "0.5,0.3,0.2"});
    CHECK(said["poses"].size() == 3);
    CHECK(!said["fit"].contains("arcs"));
    std::ofstream(folder / "path.txt") << "0 0 0\n5 0 0\n10 5 0\n20 5 0\n";
    const json laid = report(folder, {"bend", "s.obj", "-o", "out.ply", "--path", "path.txt"});
    CHECK(laid["poses"].size() == 8);
}

TEST_CASE("chain: --fit takes it from a report, and a body file keeps it") {
    const Folder folder;
    pipe(folder);
    well(folder, {"inspect", "s.obj", "--json", "fit.json"});
    (void)report(folder, {"bend", "s.obj", "--by", "30", "--folds", "0", "-o", "found.ply"});
    (void)report(folder,
                 {"bend", "s.obj", "--by", "30", "--folds", "0", "-o", "given.ply", "--fit", "fit.json"});
    CHECK(farthest(mesh::load(folder / "found.ply"), mesh::load(folder / "given.ply")) < 1e-3);
    refused(folder, 2, {"bend", "s.obj", "-o", "out.ply", "--fit", "fit.json", "--regions", "0.5,0.5"},
            {"--fit", "fit.json", "2 arcs"});
    well(folder, {"bake", "s.obj", "-o", "s.goffer", "--folds", "0"});
    const json baked = report(folder, {"inspect", "s.goffer"});
    REQUIRE(baked["regions"].size() == 2);
    CHECK(std::abs(baked["regions"][0]["rest_angle"].get<double>() - 120) < 1);
    (void)report(folder, {"bend", "s.goffer", "--by", "30", "-o", "baked.ply"});
    const glm::vec3 apart =
        extent(mesh::load(folder / "baked.ply")) - extent(mesh::load(folder / "found.ply"));
    CHECK(glm::length(apart) < 0.01f);
}

TEST_CASE("chain: --arcs says how many there are, and with it what is said for each") {
    const Folder folder;
    pipe(folder);
    CHECK(report(folder, {"inspect", "s.obj", "--arcs", "5"})["fit"]["arcs"].size() == 5);
    std::string angles, directions;
    const json found = report(folder, {"inspect", "s.obj", "--arcs", "3"});
    for (const json& arc : found["fit"]["arcs"]) {
        const std::string comma = angles.empty() ? "" : ",";
        angles += comma + std::to_string(arc["angle"].get<double>() + 5);
        directions += comma + std::to_string(arc["direction"].get<double>());
    }
    const json bent = report(folder, {"bend", "s.obj", "-o", "out.ply", "--arcs", "3", "--angles", angles,
                                      "--directions", directions, "--folds", "3,0,5"});
    REQUIRE(bent["poses"].size() == 3);
    CHECK(bent["fit"]["arcs"].size() == 3);
    for (const json& pose : bent["poses"])
        CHECK(pose["angle"].get<double>() == doctest::Approx(pose["rest_angle"].get<double>() + 5));
    CHECK(bent["regions"][0]["folds"] == 3);
    CHECK(bent["regions"][1]["folds"] == 0);
    CHECK(bent["regions"][2]["folds"] == 5);
    const json crowd =
        report(folder, {"crowd", "s.obj", "--instances", "9", "--arcs", "3", "--angles", "1,2,3"});
    CHECK(crowd["models"][0]["regions"].size() == 3);
    well(folder, {"bake", "s.obj", "-o", "s.goffer", "--arcs", "3"});
    CHECK(report(folder, {"inspect", "s.goffer"})["regions"].size() == 3);
    std::ofstream(folder / "keys.json")
        << R"({"keys": [{"time": 0, "angles": [0, 0, 0]}, {"time": 1, "angles": [9, 9, 9]}]})";
    straightened(
        folder, {"animate", "s.obj", "--keys", "keys.json", "--arcs", "3", "-o", "out.glb", "--frames", "3"});

    const std::vector<std::string> bend{"bend", "s.obj", "-o", "out.ply"};
    const auto bad = [&](const std::vector<std::string>& words, const std::vector<std::string>& said) {
        std::vector<std::string> all = bend;
        all.insert(all.end(), words.begin(), words.end());
        refused(folder, 2, all, said);
    };
    bad({"--angles", "1,2"}, {"--angles", "--arcs"});
    bad({"--arcs", "3", "--angles", "1,2"}, {"--angles: 2 for 3 regions"});
    bad({"--arcs", "3", "--regions", "0.5,0.5"}, {"--regions", "--arcs"});
    bad({"--arcs", "3", "--rest", "straight"}, {"--arcs", "--rest straight"});
    bad({"--arcs", "1"}, {"--arcs"});
    well(folder, {"inspect", "s.obj", "--json", "fit.json"});
    bad({"--arcs", "3", "--fit", "fit.json"}, {"--arcs", "fit.json", "2"});
    well(folder, {"bend", "s.obj", "-o", "out.ply", "--fit", "fit.json", "--arcs", "2", "--by", "10",
                  "--folds", "5,6"});
}

TEST_CASE("chain: keys of one angle move all of its regions") {
    const Folder folder;
    pipe(folder);
    std::ofstream(folder / "keys.json") << R"({"interpolation": "linear", "keys": [{"time": 0, "angle": 20},
                                               {"time": 2, "angle": 60, "direction": 30}]})";
    straightened(
        folder, {"animate", "s.obj", "--keys", "keys.json", "-o", "%02d.ply", "--frames", "3", "--fps", "1"});
    const auto off = [&](const char* frame, const char* angle, const char* direction) {
        (void)run(folder, {"bend", "s.obj", "-o", "bent.ply", "--angle", angle, "--direction", direction});
        return farthest(mesh::load(folder / frame), mesh::load(folder / "bent.ply"));
    };
    CHECK(off("03.ply", "60", "30") < 1e-4);
    std::ofstream(folder / "keys.json")
        << R"({"interpolation": "linear", "keys": [{"time": 0, "angle": 20, "direction": 30},
                                               {"time": 2, "angle": 60, "direction": 30}]})";
    straightened(
        folder, {"animate", "s.obj", "--keys", "keys.json", "-o", "%02d.ply", "--frames", "3", "--fps", "1"});
    CHECK(off("02.ply", "40", "30") < 1e-4);
}

TEST_CASE("chain: a crowd is bent along one arc") {
    const Folder folder;
    pipe(folder);
    const json crowd = report(folder, {"crowd", "s.obj", "--instances", "10"});
    CHECK(crowd["models"][0]["regions"].size() == 1);
}
