// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_input.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>
#include <vector>

/// Body files: baked, looked at, and bent in the place of their models.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

TEST_CASE("bake: a body file bends as its model does, to the same floats") {
    const Folder folder;
    for (const std::string model : {"log_01.glb", "insect_leg.glb", "blub_open.obj", "fuze.ply"}) {
        CAPTURE(model);
        copy_of(folder, model);
        const json baked = report(folder, {"bake", model, "-o", "body.goffer", "--rest", "arc"});
        CHECK(baked["bytes"] == std::filesystem::file_size(folder / "body.goffer"));
        const json of_file = report(folder, {"bend", "body.goffer", "--angle", "50", "-o", "a.ply"});
        const json of_model =
            report(folder, {"bend", model, "--angle", "50", "-o", "b.ply", "--rest", "arc"});
        CHECK(of_file["max_angle"].get<double>() == doctest::Approx(of_model["max_angle"].get<double>()));
        CHECK(of_file["folds"] == of_model["folds"]);
        CHECK(of_file["triangles"] == of_model["triangles"]);
        CHECK(of_file["area_after"].get<double>() ==
              doctest::Approx(of_model["area_after"].get<double>()).epsilon(1e-4));
        CHECK(!of_file.contains("bind_ms"));
        const mesh::Mesh a = mesh::load(folder / "a.ply"), b = mesh::load(folder / "b.ply");
        REQUIRE(a.positions.size() >= b.positions.size());  // one for each texture coordinate
        // The first ones are those of the model, and cutting a vertex in two moves none.
        const auto first = std::span(a.positions).first(b.positions.size());
        CHECK(std::ranges::equal(first, b.positions));
    }
}

TEST_CASE("bake: a refined model without normals is shaded as it was, whatever the order of its vertices") {
    const Folder folder;
    const std::string rod = base(folder, "rod.ply", {"--columns", "12", "--rows", "6"});
    mesh::Mesh plain = mesh::load(folder / rod);
    plain.normals = {};
    plain.source = nullptr;
    for (const std::string name : {"rod.obj", "rod.stl", "rod.glb"}) {
        CAPTURE(name);
        mesh::save(plain, folder / name);
        const json baked =
            report(folder, {"bake", name, "-o", "rod.goffer", "--axis", "z", "--refine", "on"});
        REQUIRE(baked["refined"]["triangles_after"] > 5 * baked["refined"]["triangles_before"].get<int>());
        const std::optional<bend::BodyFile> file = bend::load_file((folder / "rod.goffer").string().c_str());
        REQUIRE(file);
        const bend::Body& body = file->levels[0].body;
        std::vector<glm::vec3> at(body.vertex_count()), normals(at.size());
        bend::DeformJob job{.body = &body};
        job.positions = interleaved<3>(&at[0].x, at.size());
        job.normals = interleaved<3>(&normals[0].x, at.size());
        bend::run(job);
        const auto [low, high] = std::ranges::minmax(at, {}, &glm::vec3::z);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double rho = std::hypot(at[i].x, at[i].y);
            if (at[i].z < low.z + 0.01f || at[i].z > high.z - 0.01f) continue;
            CHECK((normals[i].x * at[i].x + normals[i].y * at[i].y) / rho > std::cos(0.1));
        }
    }
}

TEST_CASE("bake: inspect tells what is in a body file") {
    const Folder folder;
    copy_of(folder, "log_01.glb");
    well(folder,
         {"bake", "log_01.glb", "-o", "log.goffer", "--socket", "hat=0,1,0", "--socket", "side=0,0.5,0.2"});
    const json found = report(folder, {"inspect", "log.goffer"});
    REQUIRE(found["levels"].size() == 1);
    CHECK(found["levels"][0]["triangles"] == 13608);
    CHECK(found["levels"][0]["uvs"] == true);
    CHECK(found["sockets"] == json::array({"hat", "side"}));
    CHECK(found["materials"] == json::array({"basic"}));
    CHECK(found["made_from"]["model"] == "log_01.glb");
    CHECK(found["regions"][0]["folds"] == 13);
    CHECK(found["regions"][0]["max_angle"].get<double>() > 90);
    CHECK(well(folder, {"inspect", "log.goffer"}).find("sockets           2: hat, side\n") !=
          std::string::npos);
}

TEST_CASE("bake: regions bend by the angles that are given, without their shares") {
    const Folder folder;
    base(folder);
    well(folder, {"bake", "base.ply", "--regions", "0.5,0.5", "-o", "s.goffer"});
    const json from_file = report(folder, {"bend", "s.goffer", "--angles", "60,-60", "-o", "a.ply"});
    const json from_model =
        report(folder, {"bend", "base.ply", "--regions", "0.5,0.5", "--angles", "60,-60", "-o", "b.ply"});
    CHECK(from_file["regions"] == from_model["regions"]);
    CHECK(from_file["poses"] == from_model["poses"]);
    // The body's order is its own: its vertices are those of the model, region by region.
    CHECK(from_file["area_after"].get<double>() ==
          doctest::Approx(from_model["area_after"].get<double>()).epsilon(1e-6));
    refused(folder, 2, {"bend", "s.goffer", "--angles", "60", "-o", "c.ply"},
            {"--angles", "1 for 2 regions"});
    refused(folder, 2, {"bend", "base.ply", "--angles", "60,60", "-o", "c.ply"}, {"--angles", "--regions"});
}

TEST_CASE("bake: levels of detail, of which bend takes the one that is asked for") {
    const Folder folder;
    base(folder, "fine.ply");
    base(folder, "coarse.ply", {"--columns", "16", "--rows", "41"});
    well(folder, {"bake", "fine.ply", "--lod", "coarse.ply", "-o", "worm.goffer"});
    const json found = report(folder, {"inspect", "worm.goffer"});
    REQUIRE(found["levels"].size() == 2);
    CHECK(found["levels"][1]["vertices"] == 16 * 41);
    const json bent = report(folder, {"bend", "worm.goffer", "--level", "1", "--angle", "40", "-o", "a.ply"});
    CHECK(bent["vertices"] == 16 * 41);
    refused(folder, 1, {"bend", "worm.goffer", "--level", "2", "-o", "b.ply"}, {"worm.goffer", "2 levels"});
    refused(folder, 2, {"bend", "fine.ply", "--level", "1", "-o", "b.ply"}, {"--level", "fine.ply"});
    const auto warned = [&](const std::string& level) {
        const Result baked = run(folder, {"bake", "fine.ply", "--lod", level, "-o", "worm.goffer"});
        return baked.err.find(level + ": as a level of detail it is off by") != std::string::npos;
    };
    base(folder, "thin.ply", {"--radius", "0.1"});
    CHECK(!warned("coarse.ply"));
    CHECK(warned("thin.ply"));
}

TEST_CASE("bake: a crowd of body files, and of models with them, moves as the models do") {
    const Folder folder;
    base(folder);
    well(folder, {"bake", "base.ply", "--amplitude", "paper", "-o", "worm.goffer", "--refine", "off"});
    const auto crowd = [&](const Words& models) {
        return report(folder, Words{"crowd"} + models + Words{"--instances", "7", "--frames", "3"});
    };
    CHECK(crowd({"worm.goffer"})["hash"] == crowd({"base.ply"})["hash"]);
    CHECK(crowd({"worm.goffer", "base.ply"})["hash"] == crowd({"base.ply", "base.ply"})["hash"]);
    well(folder, {"bake", "base.ply", "--regions", "0.5,0.5", "-o", "s.goffer"});
    CHECK(crowd({"s.goffer"})["models"][0]["regions"].size() == 2);
    refused(folder, 1, {"crowd", "s.goffer", "worm.goffer"}, {"worm.goffer", "1 region"});
}

TEST_CASE("bake: a body file takes no word that was decided when it was baked") {
    const Folder folder;
    base(folder);
    well(folder, {"bake", "base.ply", "-o", "worm.goffer"});
    const Words choices[] = {{"--folds", "3"},
                             {"--fold-length", "1"},
                             {"--amplitude", "paper"},
                             {"--profile", "even"},
                             {"--shape", "auto"},
                             {"--paper"},
                             {"--onset", "0"},
                             {"--axis", "z"},
                             {"--rest", "straight"},
                             {"--refine", "on"},
                             {"--roundness", "0.1"},
                             {"--wrinkle-range", "0,0.5"},
                             {"--wrinkle-mask", "COLOR_0.r"}};
    for (const Words& words : choices) {
        refused(folder, 2, Words{"bend", "worm.goffer", "-o", "a.ply"} + words, {words[0], "worm.goffer"});
        refused(folder, 2, Words{"crowd", "worm.goffer"} + words, {words[0], "worm.goffer"});
    }
    refused(folder, 2, {"bend", "worm.goffer", "-o", "a.ply", "--regions", "1"}, {"--regions"});
    refused(folder, 2, {"inspect", "worm.goffer", "--axis", "z"}, {"--axis", "worm.goffer"});
    refused(folder, 1, {"bake", "worm.goffer", "-o", "b.goffer"}, {"worm.goffer", "already"});
    refused(folder, 1, {"bake", "base.ply", "--lod", "worm.goffer", "-o", "b.goffer"}, {"already"});
    refused(folder, 1, {"refine", "worm.goffer", "-o", "b.ply"}, {"worm.goffer"});
}

TEST_CASE("bake: what is asked for wrongly") {
    const Folder folder;
    base(folder);
    base(folder, "long.ply", {"--length", "20"});
    refused(folder, 2, {"bake", "base.ply", "-o", "worm.glb"}, {"-o", "worm.glb", ".goffer"});
    refused(folder, 2, {"bake", "base.ply", "-o", "base.ply"}, {"-o"});
    for (const std::string socket : {"hat", "=1,2,3", "hat=1,2", "hat=1,2,x"})
        refused(folder, 2, {"bake", "base.ply", "-o", "a.goffer", "--socket", socket}, {"--socket"});
    refused(folder, 2, {"bake", "base.ply", "-o", "a.goffer", "--socket", "a=0,0,0", "--socket", "a=0,0,1"},
            {"--socket", "two named 'a'"});
    refused(folder, 1, {"bake", "base.ply", "--lod", "long.ply", "-o", "a.goffer"},
            {"long.ply", "not a level of detail"});
    refused(folder, 1, {"bake", "base.ply", "--lod", "nothing.ply", "-o", "a.goffer"}, {"nothing.ply"});
}

TEST_CASE("bake: a damaged body file is refused with the reason") {
    const Folder folder;
    base(folder);
    well(folder, {"bake", "base.ply", "-o", "worm.goffer"});
    std::string bytes = bytes_of(folder / "worm.goffer");
    const auto write = [&](const std::string& text) {
        std::ofstream(folder / "bad.goffer", std::ios::binary) << text;
    };
    write(bytes.substr(0, bytes.size() / 2));
    for (const std::string command : {"inspect", "bend", "crowd"}) {
        const Words output = command == "bend" ? Words{"-o", "a.ply"} : Words{};
        refused(folder, 1, Words{command, "bad.goffer"} + output, {"bad.goffer", "fewer bytes"});
    }
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write(bytes);
    refused(folder, 1, {"inspect", "bad.goffer"}, {"bad.goffer", "changed since"});
    refused(folder, 2, {"inspect", "worm.goffer", "--json", "worm.goffer"}, {"--json", "worm.goffer"});
    write("x");
    refused(folder, 1, {"inspect", "bad.goffer"}, {"bad.goffer", "not a body file"});
    refused(folder, 1, {"inspect", "worm.goffer", "--max-memory", "1M"}, {"worm.goffer", "--max-memory"});
}

TEST_CASE("bake: a body file that only a runtime has made, without triangles or notes") {
    const Folder folder;
    bend::RegionInput region;
    region.length = 1;
    region.max_angle = 3;
    region.vertex_count = 4;
    const std::vector<bend::RestVertex> vertices{{0, 0, 0.1}, {2, 0, 0.1}, {4, 0, 0.1}, {0, 1, 0}};
    const std::vector<bend::RestVector> normals(4, {1, 0, 0});
    bend::BodyInput input;
    input.radius = 0.1;
    input.regions = {&region, 1};
    input.vertices = vertices;
    input.normals = normals;
    const bend::Body body = bend::Body::make(input).value();
    const auto write = [&](std::span<const std::uint32_t> triangles, std::string_view notes) {
        const bend::LevelInput level{&body, {triangles, {}, {}, {}}};
        const std::vector<std::byte> bytes = bend::save({{&level, 1}, {}, {}, notes});
        std::ofstream(folder / "bare.goffer", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    write({}, {});
    CHECK(report(folder, {"inspect", "bare.goffer"})["levels"][0]["triangles"] == 0);
    refused(folder, 1, {"bend", "bare.goffer", "-o", "a.ply"}, {"bare.goffer", "no triangles"});
    const std::vector<std::uint32_t> triangles{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const std::string deep = "{\"model\": " + std::string(30000, '[') + std::string(30000, ']') + "}";
    for (const std::string_view notes : {"", "[[[", "{\"regions\": 3}", "{\"regions\": [{\"folds\": -1e30}]}",
                                         "{\"model\": {}}", deep.c_str()}) {
        CAPTURE(notes);
        write(triangles, notes);
        CHECK(run(folder, {"inspect", "bare.goffer"}).code == 0);
        CHECK(report(folder, {"bend", "bare.goffer", "-o", "a.ply"})["vertices"] == 4);
    }
}
