// SPDX-License-Identifier: MIT
#include "support/models.hpp"

#include "command.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

using namespace goffer;
using namespace goffer::test;

namespace {

void check_same_mesh(const mesh::Mesh& bent, const mesh::Mesh& rest) {
    CHECK(bent.positions.size() == rest.positions.size());
    CHECK(bent.corners == rest.corners);
    CHECK(bent.faces == rest.faces);
    CHECK(bent.parts.size() == rest.parts.size());
    CHECK(bent.uvs == rest.uvs);
    CHECK(bent.colors == rest.colors);
}

/// At 30, 90 and the largest angle, into the format that it came in: its own triangles, and those that it is
/// given for its folds.
void check_bends(const char* name, const char* axis = "auto") {
    const std::filesystem::path file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const mesh::Mesh rest = mesh::load(file);
    const std::array<std::string, 3> angles{"90", "30", "36000"};
    for (const std::string& angle : std::span(angles).first(rounds<std::size_t>(angles.size(), 1))) {
        CAPTURE(angle);
        const auto all = report(folder, {"bend", file.string(), "-o", name, "--axis", axis, "--angle", angle,
                                         "--direction", "25", "--refine", "off"});
        CHECK(all["vertices"] == rest.positions.size());
        CHECK(all["triangles"] == mesh::triangle_count(rest));
        CHECK(std::isfinite(all["area_after"].get<double>()));
        CHECK(all["clamped"] == (std::abs(std::stod(angle)) > all["max_angle"].get<double>()));
        check_same_mesh(mesh::load(folder / name), rest);  // which refuses what is not finite
        const auto fine = report(folder, {"bend", file.string(), "-o", name, "--axis", axis, "--angle", angle,
                                          "--direction", "25"});
        const mesh::Mesh refined = mesh::load(folder / name);
        CHECK(fine["triangles"] == mesh::triangle_count(refined));
        CHECK(fine.contains("refined") == (mesh::triangle_count(refined) > mesh::triangle_count(rest)));
        CHECK(refined.parts.size() == rest.parts.size());
        CHECK(fine["folds"].get<int>() > 0);
    }
    CHECK(folder.files() == 1);
}

}  // namespace

TEST_CASE("models: banana.obj") {
    check_bends("banana.obj");
}

TEST_CASE("models: blub_open.obj") {
    check_bends("blub_open.obj");
}

TEST_CASE("models: softball.obj") {
    check_bends("softball.obj", "z");
}

TEST_CASE("models: koala.obj") {
    check_bends("koala.obj");
}

TEST_CASE("models: fuze.ply") {
    check_bends("fuze.ply");
}

TEST_CASE("models: lh_trochanterfemur.stl") {
    check_bends("lh_trochanterfemur.stl");
}

TEST_CASE("models: l_arista.stl") {
    check_bends("l_arista.stl");
}

TEST_CASE("models: cushion_02.glb") {
    check_bends("cushion_02.glb");
}

TEST_CASE("models: insect_leg.glb") {
    check_bends("insect_leg.glb");
}

TEST_CASE("models: log_01.glb") {
    check_bends("log_01.glb");
}

TEST_CASE("models: wine_bottle.glb") {
    check_bends("wine_bottle.glb");
}

TEST_CASE("models: WaterBottle.gltf") {
    check_bends("WaterBottle.gltf");
}

TEST_CASE("models: softball.obj has no long axis, the way out is named") {
    const std::filesystem::path file = model("softball.obj");
    if (file.empty()) return;
    const Folder folder;
    folder.write("out.obj", "kept");
    refused(folder, 1, {"inspect", file.string()}, {"softball.obj", "no long axis", "--axis x|y|z"});
    refused(folder, 1, {"bend", file.string(), "-o", "out.obj"}, {"softball.obj", "no long axis", "--axis"});
    CHECK(run(folder, {"inspect", file.string(), "--axis", "x"}).code == 0);
}
