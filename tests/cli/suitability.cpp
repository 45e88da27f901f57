// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

/// Bodies that are no cylinders: they are bent, and one line says why that may look odd.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

constexpr const char* begin = "the body is not a cylinder, and may look odd when bent: ";

/// Base cylinders of radius 1 and length 10, at these places.
mesh::Mesh rods(const Folder& folder, const std::vector<glm::vec3>& places) {
    const mesh::Mesh one = mesh::load(folder / base(folder, "rod.ply", {"--columns", "16", "--rows", "41"}));
    mesh::Mesh all;
    for (const glm::vec3& place : places) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const glm::vec3& p : one.positions) all.positions.push_back(p + place);
        for (const std::uint32_t corner : one.corners) all.corners.push_back(first + corner);
        all.faces.insert(all.faces.end(), one.faces.begin(), one.faces.end());
    }
    return all;
}

/// The warning of a model, which inspect and bend share; empty: none.
std::string warning(const Folder& folder, const mesh::Mesh& mesh, const std::string& name = "model.ply") {
    mesh::save(mesh, folder / name);
    const auto of = [&](const Words& words) {
        std::string found;
        const json all = report(folder, words);
        for (const std::string text : all["warnings"]) {
            if (!text.starts_with(begin)) continue;
            CHECK(found.empty());
            found = text;
        }
        return found;
    };
    const std::string inspected = of({"inspect", name, "--axis", "z"});
    CHECK(of({"bend", name, "--axis", "z", "-o", "out.ply", "--refine", "off"}) == inspected);
    return inspected;
}

/// What is said of a real model: nothing, or a line that holds `said`.
void check_warning_of_model(const char* name, const std::string& said) {
    const auto file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const json all = report(folder, {"inspect", file.string()});
    std::string found;
    for (const std::string text : all["warnings"])
        if (text.starts_with(begin)) found = text;
    CAPTURE(found);
    CHECK(said.empty() == found.empty());
    CHECK(found.find(said) != found.npos);
}

}  // namespace

TEST_CASE("suitability: a cylinder is one, whatever its file says of seams") {
    const Folder folder;
    CHECK(warning(folder, rods(folder, {{0, 0, 0}})).empty());
    CHECK(warning(folder, rods(folder, {{0, 0, 0}}), "soup.stl").empty());
    const json shape = report(folder, {"inspect", "soup.stl"})["suitability"];
    CHECK(shape["shells"] == 1);
    CHECK(shape["side_by_side"] == 0);
    CHECK(std::abs(shape["flatness"].get<double>() - 1) < 0.05);
}

TEST_CASE("suitability: parts side by side") {
    const Folder folder;
    const std::string said = warning(folder, rods(folder, {{0, 0, 0}, {3, 0, 0}, {1.5, 3, 1}}));
    CHECK(said.find("3 of its 3 separate parts lie side by side") != said.npos);
    CHECK(said.find("cut the model into its parts") != said.npos);
    // One within another, and one behind another, are not.
    CHECK(warning(folder, rods(folder, {{0, 0, 0}, {0, 0, 10.5}})).empty());
    CHECK(warning(folder, rods(folder, {{0, 0, 0}, {0.5, 0, 0}})).find("parts") == std::string::npos);
    CHECK(report(folder, {"inspect", "model.ply", "--axis", "z"})["suitability"]["shells"] == 2);
}

TEST_CASE("suitability: a flat body") {
    const Folder folder;
    const auto squashed = [&](float by) {
        mesh::Mesh mesh = rods(folder, {{0, 0, 0}});
        for (glm::vec3& p : mesh.positions) p.y /= by;
        return warning(folder, mesh);
    };
    CHECK(squashed(2).find("flat") == std::string::npos);
    const std::string said = squashed(6);
    CHECK(said.find("it is flat, ") != said.npos);
    CHECK(said.find("--direction 90, ") != said.npos);
    mesh::Mesh turned = rods(folder, {{0, 0, 0}});
    for (glm::vec3& p : turned.positions) p = {0.6f * p.x + 0.13f * p.y, 0.8f * p.x - 0.1f * p.y, p.z};
    CHECK(warning(folder, turned).find("--direction 143, ") != std::string::npos);  // across (0.6, 0.8)
}

TEST_CASE("suitability: a body far from any cylinder") {
    const Folder folder;
    mesh::Mesh mesh = rods(folder, {{0, 0, 0}});
    for (glm::vec3& p : mesh.positions) {  // four fins
        const float fin = 0.15f + 2 * std::pow(std::fabs(std::cos(2 * std::atan2(p.y, p.x))), 6.0f);
        p.x *= fin;
        p.y *= fin;
    }
    const std::string said = warning(folder, mesh);
    CHECK(said.find("radii (rms) from the base cylinder") != said.npos);
    CHECK(said.find("--axis") != said.npos);
}

// The limits were found by looking at these. Among the models that bend well, blub_open.obj, a fish with
// fins, is the farthest from a cylinder (0.51 radii), and cushion_02.glb the flattest (2.2). insect_leg.glb
// has spurs beside its claws.

TEST_CASE("suitability: blub_open.obj") {
    check_warning_of_model("blub_open.obj", "");
}

TEST_CASE("suitability: cushion_02.glb") {
    check_warning_of_model("cushion_02.glb", "");
}

TEST_CASE("suitability: insect_leg.glb") {
    check_warning_of_model("insect_leg.glb", "");
}

TEST_CASE("suitability: koala.obj") {
    check_warning_of_model("koala.obj", "");
}

TEST_CASE("suitability: banana.obj") {
    check_warning_of_model("banana.obj", "");
}

TEST_CASE("suitability: l_arista.stl, a feathery antenna") {
    check_warning_of_model("l_arista.stl", "radii (rms) from the base cylinder");
}

TEST_CASE("suitability: a body far from the origin, whose coordinates are rounded") {
    const Folder folder;
    const std::string far = "it lies so far from the origin";
    for (const float away : {0.0f, 1e4f, 1e5f}) {
        CAPTURE(away);
        mesh::Mesh mesh = rods(folder, {glm::vec3(away, 0, 0)});
        mesh.positions.push_back(glm::vec3(1e6f, 0, 5));  // what no triangle uses is no reason
        mesh::save(mesh, folder / "model.ply");
        const json warnings = report(folder, {"inspect", "model.ply", "--axis", "z"})["warnings"];
        CHECK(std::ranges::any_of(warnings, [&](const std::string& text) { return text.starts_with(far); }) ==
              (away > 5e4f));
    }
}

TEST_CASE("suitability: vertices that no face uses") {
    const Folder folder;
    mesh::Mesh rod = rods(folder, {{0, 0, 0}});
    rod.positions.insert(rod.positions.end(), {{0, 0, 5}, {3, 0, 10.005f}});  // within, and nearly
    const auto said = [&] {
        mesh::save(rod, folder / "loose.ply");
        const json all = report(folder, {"inspect", "loose.ply"});
        return all["warnings"].empty() ? std::string() : all["warnings"][0].get<std::string>();
    };
    CHECK(said().empty());
    rod.positions.emplace_back(0, 0, 12);
    CHECK(said().starts_with("a vertex that no face uses lies beyond the ends of the body"));
    rod.positions.emplace_back(0, 0, -1);
    CHECK(said().starts_with("2 vertices that no face uses lie beyond the ends of the body"));
}
