// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/angles.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// Where the center of the capped base cylinder's tip goes: it is the mesh's last vertex.
glm::dvec3 tip(const Folder& folder, const Words& words) {
    well(folder, Words{"bend", "base.ply", "-o", "out.ply"} + words);
    return mesh::load(folder / "out.ply").positions.back();
}

/// Eq 2-5 for the end of the center line: the wrinkle is 0 there.
glm::dvec3 tip_of(double angle, double direction) {
    const double alpha = angle * degree, kappa = alpha * base_radius / base_length;
    const double x = (1 - kappa) * base_length * (1 - std::cos(alpha)) / alpha;
    return {x * std::cos(direction * degree), x * std::sin(direction * degree),
            (1 - kappa) * base_length * std::sin(alpha) / alpha};
}

}  // namespace

TEST_CASE("bend: every field, with its type") {
    const Folder folder;
    const json all = report(folder, {"bend", base(folder), "-o", "out.glb", "--angle", "60", "--direction",
                                     "-20", "--threads", "1", "--isa", "scalar"});
    for (const std::string field : {"file", "vertices", "triangles", "primitives", "area", "fit", "max_angle",
                                    "folds_capacity", "warnings"}) {
        CAPTURE(field);
        CHECK(all.contains(field));
    }
    CHECK(all["pose"]["angle"] == 60.0);
    CHECK(all["pose"]["direction"] == -20.0);
    CHECK(all["folds"] == 20);
    CHECK(all["clamped"] == false);
    CHECK(all["isa"] == "scalar");
    CHECK(all["threads"] == 1);
    CHECK(all["warnings"] == json::array());
    CHECK(all["area_before"] == all["area"]);
    CHECK(std::abs(all["area_after"].get<double>() / all["area_before"].get<double>() - 1) < 3e-5);
    CHECK(all["base_area_change"].is_null());  // folds are weighted slice by slice
    CHECK(all["bind_ms"].get<double>() > 0);
    CHECK(all["deform_us"].get<double>() > 0);
}

TEST_CASE("bend: without a word about it, 90 degrees toward zero") {
    const Folder folder;
    const json all = report(folder, {"bend", base(folder), "-o", "out.ply"});
    CHECK(all["pose"]["angle"] == 90.0);
    CHECK(all["pose"]["direction"] == 0.0);
    CHECK(all["amplitude"] == "mesh");
    CHECK(all["profile"] == "even");
    CHECK_FALSE(all.contains("refined"));  // it has its rows
    CHECK(all["threads"].get<int>() > 0);
}

TEST_CASE("bend: the fit of inspect gives the same bytes as fitting") {
    const Folder folder;
    base(folder);
    for (const std::string axis : {"auto", "-z", "0.1,-0.2,1"}) {
        well(folder, {"inspect", "base.ply", "--axis", axis, "--json", "fit.json"});
        well(folder, {"bend", "base.ply", "-o", "a.glb", "--angle", "70", "--axis", axis});
        well(folder, {"bend", "base.ply", "-o", "b.glb", "--angle", "70", "--fit", "fit.json"});
        CHECK(bytes_of(folder / "a.glb") == bytes_of(folder / "b.glb"));
    }
    const json part = json::parse(bytes_of(folder / "fit.json"))["fit"];
    folder.write("part.json", part.dump());
    well(folder, {"bend", "base.ply", "-o", "c.glb", "--angle", "70", "--fit", "part.json"});
    CHECK(bytes_of(folder / "b.glb") == bytes_of(folder / "c.glb"));
}

TEST_CASE("bend: beyond the largest angle it is clamped, and says so") {
    const Folder folder;
    base(folder);
    for (const std::string amplitude : {"paper", "area", "none"}) {
        for (const double sign : {1.0, -1.0}) {
            CAPTURE(amplitude);
            const std::string angle = std::to_string(sign * 2000);
            const Words words{"bend", "base.ply", "-o", "out.ply", "--amplitude", amplitude};
            const json all = report(folder, words + Words{"--angle", angle});
            CHECK(all["clamped"] == true);
            CHECK(all["pose"]["angle"].get<double>() == sign * all["max_angle"].get<double>());
            REQUIRE(all["warnings"].size() == 1);
            CHECK(all["warnings"][0].get<std::string>().find("beyond the largest") != std::string::npos);
            well(folder, Words{"bend", "base.ply", "-o", "limit.ply", "--amplitude", amplitude, "--angle",
                               std::to_string(sign * (all["max_angle"].get<double>() - 1e-4))});
            CHECK(farthest(mesh::load(folder / "out.ply"), mesh::load(folder / "limit.ply")) < 2e-5);
            // As typed from a report, which may have rounded it upward.
            const double shown = all["max_angle"].get<double>() * (1 + 5e-6);
            const auto warnings = [&](double size) {
                return report(folder, words + Words{"--angle", std::to_string(sign * size)})["warnings"];
            };
            CHECK(warnings(shown).empty());
            CHECK(warnings(shown * (1 + 2e-5)).size() == 1);
        }
    }
}

TEST_CASE("bend: the tip goes where the closed form says, in the direction asked for") {
    const Folder folder;
    base(folder, "base.ply", {"--caps"});
    for (const double angle : {1e-3, 20.0, 90.0, 170.0}) {
        for (const double direction : {30.0, 200.0, 0.0, 90.0, -45.0, 720.0}) {
            if (!all_rounds() && direction != 30 && direction != 200) continue;
            CAPTURE(angle);
            CAPTURE(direction);
            const Words pose{"--angle", std::to_string(angle), "--direction", std::to_string(direction)};
            CHECK(glm::length(tip(folder, pose) - tip_of(angle, direction)) < 6e-6);
        }
    }
}

TEST_CASE("bend: a negative angle is the other way") {
    const Folder folder;
    base(folder, "base.ply", {"--caps"});
    CHECK(glm::length(tip(folder, {"--angle", "-50", "--direction", "20"}) - tip_of(50, 200)) < 2e-6);
    well(folder, {"bend", "base.ply", "-o", "other.ply", "--angle", "50", "--direction", "200"});
    CHECK(farthest(mesh::load(folder / "out.ply"), mesh::load(folder / "other.ply")) < 4e-7 * base_length);
}

TEST_CASE("bend: direction turns from e1 to e3 x e1 whichever way the axis points") {
    const Folder folder;
    base(folder, "base.ply", {"--caps"});
    // The axis is -z: the tip is at the origin now, e1 is x, e2 is -y. Base and tip change places.
    const auto first = [&](const char* direction) {
        (void)tip(folder, {"--axis", "-z", "--angle", "90", "--direction", direction});
        const auto positions = mesh::load(folder / "out.ply").positions;
        return glm::dvec3(positions[positions.size() - 2]);
    };
    const glm::dvec3 straight = tip_of(90, 0);
    CHECK(glm::length(first("0") - glm::dvec3(straight.x, 0, base_length - straight.z)) < 1e-6);
    CHECK(glm::length(first("90") - glm::dvec3(0, -straight.x, base_length - straight.z)) < 2e-6);
}

TEST_CASE("bend: a picture or a report alone, without a model, is the same") {
    const Folder folder;
    base(folder);
    (void)well(folder, {"bend", "base.ply", "-o", "out.ply", "--png", "both.png", "--size", "64x48"});
    const std::string lines = well(folder, {"bend", "base.ply", "--png", "alone.png", "--size", "64x48"});
    CHECK(lines.find("written") == lines.npos);
    CHECK(bytes_of(folder / "alone.png") == bytes_of(folder / "both.png"));
    (void)well(folder, {"bend", "base.ply", "--json", "alone.json"});
    CHECK(folder.files() == 5);
}

TEST_CASE("bend: at angle 0 the mesh comes back") {
    const Folder folder;
    base(folder, "base.ply", {"--caps"});
    for (const std::string angle : {"0", "-0", "1e-30"}) {
        well(folder, {"bend", "base.ply", "-o", "out.ply", "--angle", angle, "--direction", "33"});
        CHECK(farthest(mesh::load(folder / "base.ply"), mesh::load(folder / "out.ply")) <=
              1e-7 * base_length);
    }
}

TEST_CASE("bend: instruction sets agree") {
    const Folder folder;
    base(folder);
    const Words words{"bend", "base.ply", "-o", "out.ply", "--angle", "140", "--direction", "70", "--isa"};
    well(folder, words + Words{"scalar"});
    const mesh::Mesh scalar = mesh::load(folder / "out.ply");
    for (const std::string isa : {"sse4.2", "avx2", "avx512", "neon"}) {
        const Result result = run(folder, words + Words{isa, "--json", "report.json"});
        if (result.code != 0) {
            CHECK(result.code == 1);
            CHECK(result.err.find("choose one of auto, scalar") != std::string::npos);
            continue;
        }
        CAPTURE(isa);
        CHECK(json::parse(bytes_of(folder / "report.json"))["isa"] == isa);
        CHECK(farthest(mesh::load(folder / "out.ply"), scalar) < 5e-7 * base_length);
    }
}

TEST_CASE("bend: the bytes do not depend on the number of threads") {
    const Folder folder;
    base(folder, "base.ply", {"--columns", "128", "--rows", rounds("513", "257")});
    std::string one;
    for (const std::string threads : {"1", "2", "7", "0"}) {
        const json all =
            report(folder, {"bend", "base.ply", "-o", "out.glb", "--direction", "10", "--threads", threads});
        if (std::string(threads) != "0") CHECK(all["threads"] <= std::stoi(threads));
        if (one.empty()) one = bytes_of(folder / "out.glb");
        CHECK(bytes_of(folder / "out.glb") == one);
    }
}

TEST_CASE("bend: amplitudes and profiles") {
    const Folder folder;
    base(folder);
    const auto change = [&](const Words& words) {
        const json all = report(folder, Words{"bend", "base.ply", "-o", "out.ply", "--folds", "4"} + words);
        CHECK(all["warnings"] == json::array());
        return all["base_area_change"].get<double>();
    };
    const double kappa = std::numbers::pi / 2 * base_radius / base_length;
    const Words damped{"--profile", "damped", "--amplitude"};
    CHECK(std::abs(change({"--amplitude", "none"}) + kappa) < 1e-6);
    const mesh::Mesh bare = mesh::load(folder / "out.ply");
    CHECK(std::abs(change(damped + Words{"area"})) < 1e-12);
    const mesh::Mesh area = mesh::load(folder / "out.ply");
    CHECK(change({"--paper"}) > 1e-3);
    const mesh::Mesh paper = mesh::load(folder / "out.ply");
    const double creased = change(damped + Words{"paper"});
    CHECK(change({"--profile", "smooth", "--amplitude", "paper"}) != creased);
    const mesh::Mesh smooth = mesh::load(folder / "out.ply");
    CHECK(farthest(bare, paper) > 0.1 * base_radius);
    CHECK(farthest(area, paper) > 1e-3 * base_radius);
    CHECK(farthest(smooth, paper) > 0.01 * base_radius);
}

TEST_CASE("bend: no folds is the bare bend") {
    const Folder folder;
    base(folder);
    well(folder, {"bend", "base.ply", "-o", "a.ply", "--folds", "0"});
    const json none = report(folder, {"bend", "base.ply", "-o", "b.ply", "--amplitude", "none"});
    CHECK(none["folds"] == 0);
    CHECK(bytes_of(folder / "a.ply") == bytes_of(folder / "b.ply"));
}

TEST_CASE("bend: area that wrinkles do not make up for is said, unless somebody said how to wrinkle") {
    const Folder folder;
    base(folder, "base.ply", {"--length", "2300", "--columns", "6", "--rows", "601"});  // radii
    const auto warnings = [&](const Words& words) {
        json said =
            report(folder, Words{"bend", "base.ply", "-o", "out.ply", "--angle", "max"} + words)["warnings"];
        REQUIRE(!said.empty());
        CHECK(said[0] == "this is more than a full turn: parts of the body may go through each other");
        said.erase(0);
        return said;
    };
    const json said = warnings({});
    REQUIRE(said.size() == 1);
    CHECK(said[0].get<std::string>().starts_with("the area changes by -36."));
    CHECK(warnings({"--amplitude", "none"}).empty());
    CHECK(warnings({"--folds", "0"}).empty());
    CHECK(warnings({"--regions", "0.5,0.5"}).empty());
}

TEST_CASE("bend: folds that the mesh cannot carry are allowed with a warning") {
    const Folder folder;
    base(folder);
    const Words words{"bend", "base.ply", "-o", "out.ply", "--folds", "64", "--refine", "off"};
    const Result result = run(folder, words);
    CHECK(result.code == 0);
    CHECK(result.err.starts_with("goffer: warning: the mesh has vertices for 20 folds, not 64"));
    CHECK(result.err.find("the area may not be kept") != result.err.npos);
    const json all = report(folder, words);
    CHECK(all["folds"] == 64);
    CHECK(all["warnings"].size() == 1);
    const json paper = report(folder, words + Words{"--paper"});
    REQUIRE(paper["warnings"].size() == 1);
    const std::string said = paper["warnings"][0];
    CHECK(said.starts_with("the mesh has vertices for 10 folds, not 64"));
    CHECK(said.find("the area is not kept") != said.npos);
}

TEST_CASE("bend: a fit that the model does not fill is noticed") {
    const Folder folder;
    well(folder, {"inspect", base(folder), "--json", "fit.json"});
    base(folder, "short.ply", {"--length", "4"});
    const json all = report(folder, {"bend", "short.ply", "-o", "out.ply", "--fit", "fit.json"});
    REQUIRE(all["warnings"].size() == 1);
    CHECK(all["warnings"][0].get<std::string>().starts_with("the mesh takes up 40 %"));
}
