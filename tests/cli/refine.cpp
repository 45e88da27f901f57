// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "mesh/refined.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// A cylinder of L = 10, r = 1 whose sides are one row of quads.
std::string coarse(const Folder& folder, const std::string& columns = "64") {
    return base(folder, "coarse.ply", {"--columns", columns, "--rows", "2", "--caps"});
}

bool begins_with(const mesh::Mesh& now, const mesh::Mesh& was, float within) {
    const auto near = [&](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) <= within; };
    return now.positions.size() >= was.positions.size() &&
           std::equal(was.positions.begin(), was.positions.end(), now.positions.begin(), near);
}

void check_refined_model(const char* name) {
    const std::filesystem::path file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const json all = report(folder, {"bend", file.string(), "-o", name, "--refine", "--folds", "6", "--angle",
                                     "90", "--rest", "arc"});
    CHECK(all["folds"] == 6);
    CHECK(all["folds_capacity"].get<int>() >= 6);
    CHECK(all["refined"]["triangles_after"].get<int>() >= all["refined"]["triangles_before"].get<int>());
    CHECK(all["refined"]["triangles_after"].get<int>() < 12 * all["refined"]["triangles_before"].get<int>());
    const mesh::Mesh before = mesh::load(file), bent = mesh::load(folder / name);
    CHECK(mesh::triangle_count(bent) == all["triangles"].get<std::size_t>());
    CHECK(bent.parts.size() == before.parts.size());
    CHECK(bent.uvs.size() == before.uvs.size());
    CHECK(bent.colors.empty() == before.colors.empty());
    CHECK((open_edges(bent) == 0) == (open_edges(before) == 0));
    (void)report(folder, {"refine", file.string(), "-o", "fine.glb", "--folds", "6", "--rest", "arc"});
    CHECK(report(folder, {"inspect", "fine.glb", "--rest", "arc"})["folds_capacity"].get<int>() >= 6);
}

}  // namespace

TEST_CASE("refine: a bare cylinder gets the rows of its folds") {
    const Folder folder;
    coarse(folder);
    const json all = report(folder, {"refine", "coarse.ply", "-o", "fine.ply", "--folds", "12"});
    CHECK(all["refined"]["folds"] == 12);
    CHECK(all["refined"]["vertices_before"] == 130);
    CHECK(all["refined"]["vertices_after"] == 130 + 2 * 64 * 95);
    CHECK(all["refined"]["triangles_before"] == 4 * 64);
    CHECK(all["refined"]["triangles_after"] == 2 * 64 + 2 * 64 * 191);
    CHECK(all["vertices"] == all["refined"]["vertices_after"]);
    CHECK(all["triangles"] == all["refined"]["triangles_after"]);
    CHECK(all["folds_capacity"] == 12);
    CHECK(all["warnings"] == json::array());
    const mesh::Mesh fine = mesh::load(folder / "fine.ply");
    CHECK(begins_with(fine, mesh::load(folder / "coarse.ply"), 0));
    CHECK(open_edges(fine) == 0);
    CHECK(report(folder, {"inspect", "coarse.ply"})["folds_capacity"] == 0);
    CHECK(report(folder, {"inspect", "fine.ply"})["folds_capacity"] == 12);
    // The paper counts them over half the length.
    CHECK(report(folder, {"bend", "fine.ply", "-o", "out.ply", "--paper"})["folds_capacity"] == 6);
}

TEST_CASE("refine: without a number, for the folds that suit the body") {
    const Folder folder;
    coarse(folder);
    CHECK(report(folder, {"refine", "coarse.ply", "-o", "fine.ply"})["refined"]["folds"] == 20);
    const json bent = report(folder, {"bend", "coarse.ply", "-o", "bent.ply", "--refine"});
    CHECK(bent["folds"] == 20);
    CHECK(bent["folds_capacity"] == 20);
    CHECK(bent["refined"]["folds"] == 20);
    CHECK(bent["warnings"] == json::array());
    const json paper = report(folder, {"bend", "coarse.ply", "-o", "bent.ply", "--refine", "--paper"});
    CHECK(paper["folds"] == 5);
    CHECK(paper["folds_capacity"] == 5);
    CHECK(paper["refined"]["folds"] == 5);
    CHECK(paper["warnings"] == json::array());
    // a body too short for a fold of the paper's on either side of its middle
    base(folder, "ring.ply", {"--length", "1", "--radius", "2", "--rows", "2"});
    CHECK(report(folder, {"refine", "ring.ply", "-o", "out.ply", "--axis", "z"})["refined"]["folds"] == 4);
    const json ring = report(
        folder, {"bend", "ring.ply", "-o", "out.ply", "--axis", "z", "--angle", "10", "--refine", "--paper"});
    CHECK(ring["refined"]["triangles_after"] == ring["refined"]["triangles_before"]);
    REQUIRE(ring["warnings"].size() == 1);
    CHECK(ring["warnings"][0].get<std::string>().find("too short") != std::string::npos);
}

TEST_CASE("refine: bend --refine is refine, then bend") {
    const Folder folder;
    coarse(folder);
    well(folder, {"inspect", "coarse.ply", "--json", "fit.json"});
    const Words pose{"--fit", "fit.json", "--folds", "4", "--angle", "70", "--direction", "20"};
    const std::string out = well(folder, Words{"bend", "coarse.ply", "-o", "one.ply", "--refine"} + pose);
    CHECK(
        out.find("refined           from 256 to 8192 triangles, from 130 to 4098 vertices, for 4 folds\n") !=
        out.npos);
    well(folder, {"refine", "coarse.ply", "-o", "fine.ply", "--fit", "fit.json", "--folds", "4"});
    well(folder, Words{"bend", "fine.ply", "-o", "two.ply"} + pose);
    CHECK(bytes_of(folder / "one.ply") == bytes_of(folder / "two.ply"));
}

TEST_CASE("refine: what has its rows is left as it is, and only with the word is it said") {
    const Folder folder;
    base(folder);
    well(folder, {"refine", "base.ply", "-o", "same.ply", "--folds", "10"});
    CHECK(bytes_of(folder / "same.ply") == bytes_of(folder / "base.ply"));
    for (const Words& words : {Words{}, {"--refine", "auto"}, {"--refine", "off"}, {"--folds", "0"}})
        CHECK(!report(folder, Words{"bend", "base.ply", "-o", "none.ply"} + words).contains("refined"));
    const std::string said = well(folder, {"bend", "base.ply", "-o", "out.ply"});
    CHECK(said.find("refined") == said.npos);
    const json all = report(folder, {"bend", "base.ply", "-o", "refined.ply", "--refine"});
    CHECK(all["refined"]["triangles_after"] == all["refined"]["triangles_before"]);
    CHECK(bytes_of(folder / "out.ply") == bytes_of(folder / "refined.ply"));
}

TEST_CASE("refine: at angle 0 the refined mesh comes back, its first vertices those of the file (P1)") {
    const Folder folder;
    coarse(folder);
    well(folder, {"refine", "coarse.ply", "-o", "fine.ply", "--folds", "6"});
    well(folder, {"bend", "coarse.ply", "-o", "out.ply", "--refine", "--folds", "6", "--angle", "0"});
    const mesh::Mesh out = mesh::load(folder / "out.ply"), fine = mesh::load(folder / "fine.ply");
    CHECK(out.positions.size() == fine.positions.size());
    CHECK(begins_with(out, fine, 1e-5f));
    CHECK(begins_with(out, mesh::load(folder / "coarse.ply"), 1e-5f));
}

TEST_CASE("refine: a hose of few sides gets columns where it gets rows, and no others") {
    const Folder folder;
    const auto triangles = [&](const std::string& sides, const Words& words) {
        base(folder, "hose.ply", {"--columns", sides, "--rows", "2", "--caps"});
        const json all = report(folder, Words{"bend", "hose.ply", "-o", "out.ply"} + words);
        CHECK(all["warnings"] == json::array());
        CHECK(open_edges(mesh::load(folder / "out.ply")) == 0);
        return all["triangles"].get<int>();
    };
    // 20 folds of 8 rows
    CHECK(triangles("6", {}) > 1.5 * 12 * 320);
    CHECK(triangles("6", {}) < 2 * 12 * 320);
    CHECK(triangles("12", {}) == 2 * 12 + 2 * 12 * (2 * 160 - 1));
    CHECK(triangles("6", {"--folds", "0"}) == 24);

    base(folder, "hose.ply", {"--columns", "6", "--rows", "2", "--caps"});
    well(folder, {"refine", "hose.ply", "-o", "fine.ply"});
    well(folder, {"bend", "hose.ply", "-o", "rest.ply", "--angle", "0"});
    const mesh::Mesh fine = mesh::load(folder / "fine.ply");
    CHECK(begins_with(mesh::load(folder / "rest.ply"), fine, 1e-5f));
    CHECK(begins_with(fine, mesh::load(folder / "hose.ply"), 0));
    const json again = report(folder, {"refine", "fine.ply", "-o", "same.ply", "--folds", "20"});
    CHECK(again["refined"]["triangles_after"] == again["refined"]["triangles_before"]);
    CHECK(bytes_of(folder / "same.ply") == bytes_of(folder / "fine.ply"));
}

TEST_CASE("refine: a coarse mesh keeps its area as the base does") {
    const Folder folder;
    coarse(folder, "128");
    for (const std::string angle : {"30", "90", "150"}) {
        CAPTURE(angle);
        const Words words{"bend", "coarse.ply", "-o", "out.ply", "--angle", angle, "--folds", "6", "--paper"};
        const auto change = [](const json& all) {
            return all["area_after"].get<double>() / all["area_before"].get<double>() - 1;
        };
        const json fine = report(folder, words + Words{"--refine", "on"});
        CHECK(fine["warnings"] == json::array());
        CHECK(std::abs(change(fine)) < 0.01);
        const json rough = report(folder, words + Words{"--refine", "off"});
        CHECK(std::abs(change(rough)) > 0.04);
        REQUIRE(rough["warnings"].size() == 1);
        CHECK(rough["warnings"][0].get<std::string>().find("goffer refine") != std::string::npos);
        // Without a word it is refined, and keeps its own area.
        const json plain = report(folder, {"bend", "coarse.ply", "-o", "out.ply", "--angle", angle});
        CHECK(plain["warnings"] == json::array());
        CHECK(plain["refined"]["folds"] == 20);
        CHECK(std::abs(change(plain)) < 5e-5);
    }
}

TEST_CASE("refine: a mesh that stays coarse has fewer folds or none, and it is said") {
    const Folder folder;
    const auto folds = [&](const std::string& rows, const std::string& said) {
        CAPTURE(rows);
        base(folder, "coarse.ply", {"--columns", "24", "--rows", rows});
        const json all = report(folder, {"bend", "coarse.ply", "-o", "out.ply", "--refine", "off"});
        CHECK_FALSE(all.contains("refined"));
        const json warnings = all["warnings"];
        const bool lost = all["area_after"].get<double>() < 0.99 * all["area_before"].get<double>();
        REQUIRE(warnings.size() == (said.empty() ? 0U : 1U) + (lost ? 1U : 0U));
        if (lost)
            CHECK(warnings[1].get<std::string>().find("so few folds do not make up") != std::string::npos);
        if (!said.empty()) {
            const std::string warning = warnings[0];
            CHECK(warning.starts_with(said));
            CHECK(warning.find("20 would suit its length") != warning.npos);
            CHECK(warning.find("goffer refine") != warning.npos);
        }
        return all["folds"].get<int>();
    };
    CHECK(folds("9", "bent without wrinkles: the mesh's rows are too far apart") == 0);
    CHECK(folds("33", "bent without wrinkles: the mesh's rows are too far apart") == 0);
    CHECK(folds("37", "only 4 folds, and ") == 4);
    CHECK(folds("41", "only 5 folds, and ") == 5);
    CHECK(folds("81", "") == 10);
    CHECK(folds("161", "") == 20);
    // Too long for its folds: rows would not help.
    base(folder, "long.ply", {"--columns", "4", "--length", "2700", "--rows", "12001"});
    const json all = report(folder, {"bend", "long.ply", "-o", "out.ply", "--refine", "off"});
    CHECK(all["folds"] == 0);
    REQUIRE(all["warnings"].size() == 1);
    CHECK(all["warnings"][0].get<std::string>().find("--regions") != std::string::npos);
}

TEST_CASE("refine: wine_bottle.glb carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("wine_bottle.glb");
}

TEST_CASE("refine: WaterBottle.gltf carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("WaterBottle.gltf");
}

TEST_CASE("refine: log_01.glb carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("log_01.glb");
}

TEST_CASE("refine: cushion_02.glb carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("cushion_02.glb");
}

TEST_CASE("refine: insect_leg.glb carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("insect_leg.glb");
}

TEST_CASE("refine: fuze.ply carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("fuze.ply");
}

TEST_CASE("refine: banana.obj carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("banana.obj");
}

TEST_CASE("refine: lh_trochanterfemur.stl carries six folds at 90 degrees, and what was closed is closed") {
    check_refined_model("lh_trochanterfemur.stl");
}

TEST_CASE("refine: bad words, bad files, and more than there is room for") {
    const Folder folder;
    coarse(folder);
    folder.write("out.ply", "kept");
    const Words refine{"refine", "coarse.ply", "-o", "out.ply"};
    refused(folder, 2, {"bend", "coarse.ply", "-o", "out.ply", "--refine", "--folds", "0"},
            {"--refine", "--folds 0", "nothing to refine for"});
    for (const std::string word : {"0", "513", "-1", "many"})
        refused(folder, 2, refine + Words{"--folds", word}, {"--folds"});
    refused(folder, 2, {"refine", "coarse.ply"}, {"--output"});
    refused(folder, 2, {"refine", "coarse.ply", "-o", "out.txt"}, {"out.txt"});
    refused(folder, 2, {"refine", "coarse.ply", "-o", "coarse.ply"}, {"coarse.ply"});
    refused(folder, 2, refine + Words{"--axis", "z", "--fit", "fit.json"}, {"--axis", "--fit"});
    refused(folder, 1, {"refine", "none.ply", "-o", "out.ply"}, {"none.ply", "no such file"});
    base(folder, "wide.ply", {"--columns", "6000", "--rows", "2"});
    refused(folder, 1, {"refine", "wide.ply", "-o", "out.ply", "--folds", "64", "--max-memory", "100M"},
            {"wide.ply: refined, the mesh would have",
             "allowed; ask for fewer folds, or allow more with --max-memory"});
}
