// SPDX-License-Identifier: MIT
#include "mesh/gltf_valid.hpp"
#include "support/models.hpp"
#include "textures.hpp"

#include <goffer/io/error.hpp>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

using namespace goffer;
using namespace goffer::test;

TEST_CASE("vertex texture: the mesh beside it has the clip's vertices in their order, with their numbers") {
    const Folder folder;
    BendingModel bending(model("wine_bottle.glb"), 2);
    saved_texture(bending, bending.model, bending.arrays, folder / "a.json");
    const mesh::Mesh still = mesh::load(folder / "a.mesh.glb");
    REQUIRE(still.positions == bending.arrays.positions);
    REQUIRE(still.uvs.size() == 2);
    REQUIRE(still.uvs[1].per_vertex());
    int wrong = 0;
    for (std::size_t i = 0; i < still.positions.size(); ++i) {
        wrong += still.uvs[1].values[i] != glm::vec2(static_cast<float>(i), 1) ? 1 : 0;
        wrong += farthest({still.uvs[0].values[i], 0}, {bending.arrays.uvs[i], 0}) > 1e-6 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(mesh::triangles(still) == bending.arrays.triangles);
    CHECK(still.parts.size() == bending.model.parts.size());
    CHECK(still.materials.size() == bending.model.materials.size());
}

TEST_CASE("vertex texture: the mesh beside it has the parts of polygons, and colors") {
    const Folder folder;
    mesh::Mesh model;
    model.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    model.corners = {0, 1, 2, 3, 1, 4, 2};
    model.faces = {4, 3};
    model.materials = {{"red", {1, 0, 0, 1}}, {"blue", {0, 0, 1, 1}}};
    model.parts = {{"square", 1, 0, 1}, {"triangle", 0, 1, 1}};
    model.colors.assign(5, glm::vec4(1));
    model.colors[4] = {0, 0.5f, 0, 1};
    model.linear_colors = true;
    MovingPoints points(5, 2, false);
    saved_texture(points, model, mesh::vertex_arrays(model), folder / "a.json");
    const mesh::Mesh still = mesh::load(folder / "a.mesh.glb");
    REQUIRE(still.parts.size() == 2);
    CHECK(still.parts[0].face_count == 2);
    CHECK(still.parts[1].face_count == 1);
    CHECK(still.materials.at(static_cast<std::size_t>(still.parts[0].material)).name == "blue");
    CHECK(still.materials.at(static_cast<std::size_t>(still.parts[1].material)).name == "red");
    CHECK(still.colors == model.colors);
}

TEST_CASE("vertex texture: its files are known before, and the model of the same name is none of them") {
    const Folder folder;
    const std::filesystem::path file = folder / "worm.json";
    folder.write("worm.glb", "the user's own");
    const std::vector<std::filesystem::path> expected = {file,
                                                         folder / "worm.positions.png",
                                                         folder / "worm.normals.png",
                                                         folder / "worm.mesh.glb",
                                                         folder / "worm.glsl",
                                                         folder / "worm.hlsl"};
    CHECK(clip::vertex_texture_files(file) == expected);
    CHECK(folder.files() == 1);
    const mesh::Mesh model = strip(300);
    MovingPoints points(300, 9, true);
    CHECK(saved_texture(points, model, mesh::vertex_arrays(model), file).files == expected);
    CHECK(bytes_of(folder / "worm.glb") == "the user's own");
    CHECK(folder.files() == 7);
    const std::string message =
        message_of<io::Error>([&] { (void)clip::vertex_texture_files(folder / "worm.glb"); });
    CHECK(tells(message, "not .json"));
}

TEST_CASE("vertex texture: a name that is not UTF-8 is replaced in the JSON alone") {
    const Folder folder;
    const mesh::Mesh model = strip(9);
    MovingPoints points(9, 3, false);
    const clip::VertexTexture texture =
        saved_texture(points, model, mesh::vertex_arrays(model), folder / "a\xff.json");
    for (const auto& file : texture.files) CHECK(std::filesystem::is_regular_file(file));
    CHECK(nlohmann::json::parse(bytes_of(folder / "a\xff.json"))["mesh"] == "a\xef\xbf\xbd.mesh.glb");
}

TEST_CASE("vertex texture: a mesh that cannot be beside it is refused before any frame is read") {
    class Counted : public MovingPoints {
    public:
        Counted() : MovingPoints(9, 3, false) {}
        void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
            ++reads;
            MovingPoints::read(frame, positions, normals);
        }
        int reads = 0;
    } points;
    const Folder folder;
    mesh::Mesh model = strip(9);
    const mesh::VertexArrays arrays = mesh::vertex_arrays(model);
    model.parts = {{"twice", -1, 0, 7}, {"twice", -1, 0, 7}};
    const std::string message =
        message_of<mesh::Error>([&] { saved_texture(points, model, arrays, folder / "a.json"); });
    CHECK(tells(message, "part"));
    CHECK(points.reads == 0);
    CHECK(folder.files() == 0);
}

TEST_CASE("vertex texture: a normal that is not finite is refused, and nothing is left") {
    class Unlit : public MovingPoints {
    public:
        Unlit() : MovingPoints(9, 3, false) {}
        void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) override {
            MovingPoints::read(frame, positions, normals);
            if (frame == 2 && !normals.empty()) normals[7].y = std::numeric_limits<float>::quiet_NaN();
        }
    } unlit;
    const Folder folder;
    const mesh::Mesh model = strip(9);
    const std::string message = message_of<io::Error>(
        [&] { saved_texture(unlit, model, mesh::vertex_arrays(model), folder / "a.json"); });
    CHECK(tells(message, "frame 2, normal 7 (counted from 0) is not finite"));
    CHECK(folder.files() == 0);
}

TEST_CASE("vertex texture: the mesh beside it has no errors in Khronos' validator") {
    const Folder folder;
    BendingModel bending(model("wine_bottle.glb"), 2);
    saved_texture(bending, bending.model, bending.arrays, folder / "a.json");
    check_valid({folder / "a.mesh.glb"});
}
