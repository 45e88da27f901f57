// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace goffer;
using namespace goffer::test;

namespace {

/// Every edge of a triangle is another's edge the other way round.
bool watertight(const mesh::Mesh& mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < mesh.corners.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            if (!edges.emplace(mesh.corners[t + i], mesh.corners[t + (i + 1) % 3]).second) return false;
    for (const auto& [from, to] : edges)
        if (!edges.contains({to, from})) return false;
    return true;
}

}  // namespace

TEST_CASE("base: counts, sizes and place") {
    const Folder folder;
    const Words size{"base", "--length", "7.5", "--radius", "0.25", "--columns", "5", "--rows", "7"};
    well(folder, size + Words{"-o", "b.ply"});
    const mesh::Mesh mesh = mesh::load(folder / "b.ply");
    CHECK(mesh.positions.size() == 35);
    CHECK(mesh::triangle_count(mesh) == 60);
    CHECK_FALSE(watertight(mesh));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        CHECK(std::hypot(p.x, p.y) == doctest::Approx(0.25));
        CHECK(p.z == doctest::Approx(1.25 * static_cast<double>(i / 5)));
    }
    CHECK(mesh.positions[0].x == 0.25f);
}

TEST_CASE("base: caps close both ends") {
    const Folder folder;
    base(folder, "b.ply", {"--columns", "5", "--rows", "7", "--caps"});
    const mesh::Mesh mesh = mesh::load(folder / "b.ply");
    CHECK(mesh.positions.size() == 37);
    CHECK(mesh::triangle_count(mesh) == 70);
    CHECK(watertight(mesh));
}

TEST_CASE("base: the same mesh in every format") {
    const Folder folder;
    for (const std::string ending : {".obj", ".ply", ".stl", ".glb", ".gltf"}) {
        CAPTURE(ending);
        const std::string name = base(folder, std::string("b") + ending, {"--columns", "8", "--rows", "9"});
        const mesh::Mesh mesh = mesh::load(folder / name);
        CHECK(mesh::triangle_count(mesh) == 128);
        CHECK(mesh.positions.size() == (std::string(ending) == ".stl" ? 384u : 72u));
    }
    CHECK(folder.files() == 5);
}

TEST_CASE("base: nonsense is refused") {
    const Folder folder;
    folder.write("out.ply", "kept");
    const auto refuse = [&](const Words& words) {
        refused(folder, 2, Words{"base", "-o", "out.ply"} + words, {words[0]});
    };
    for (const std::string size : {"0", "-1", "nan", "inf", "1e300", "1e-300", "ten", ""}) {
        refuse({"--length", size});
        refuse({"--radius", size});
    }
    for (const std::string count : {"0", "1", "-3", "4.5", "1e9", "many"}) {
        refuse({"--columns", count});
        refuse({"--rows", count});
    }
    refuse({"--columns", "1000000", "--rows", "1000000"});
    refused(folder, 2, {"base", "-o", "out.xyz"}, {"out.xyz", ".glb"});
    refused(folder, 1, {"base", "-o", "no/out.ply"}, {"no/out.ply", "folder"});
}
