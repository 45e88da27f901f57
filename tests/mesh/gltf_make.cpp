// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "support/models.hpp"

using namespace goffer::test;
using goffer::mesh::Attribute;
using goffer::mesh::Mesh;

namespace {

/// Two squares that share an edge, each with its own normal and UVs, as an OBJ has them.
Mesh folded() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {7, 7, 7}};
    mesh.corners = {0, 1, 2, 3, 1, 4, 5, 2};
    mesh.faces = {4, 4};
    mesh.normals = {{{0, 0, 2}, {-3, 0, 0}}, {0, 0, 0, 0, 1, 1, 1, 1}};
    mesh.uvs = {{{{0, 0}, {0.5f, 0.5f}}, {0, 0, 0, 0, 0, 1, 1, Attribute<glm::vec2>::none}}};
    mesh.parts = {{"floor", 0, 0, 1}, {"wall", 1, 1, 1}};
    mesh.materials = {{"red", {1, 0, 0, 1}}, {"glass", {0, 2, 0, 0.5f}}};
    return mesh;
}

}  // namespace

TEST_CASE("gltf made: corners that differ in any stream are vertices, in the order of the mesh's") {
    const Mesh again = reloaded(folded(), "o.glb");
    const std::vector<glm::vec3> expected{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0},
                                          {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {7, 7, 7}};
    CHECK(again.positions == expected);
    CHECK(again.normals.values[1] == glm::vec3(0, 0, 1));
    CHECK(again.normals.values[2] == glm::vec3(-1, 0, 0));
    CHECK(again.uvs[0].values[7] == glm::vec2(0.5f));
    CHECK(again.uvs[0].values[4] == glm::vec2(0));
    CHECK(again.corners == std::vector<std::uint32_t>{0, 1, 3, 0, 3, 5, 2, 6, 7, 2, 7, 4});
}

TEST_CASE("gltf made: parts, names, materials and colors are carried") {
    Mesh mesh = folded();
    mesh.colors.assign(7, {0.25f, 2, std::nanf(""), 1});
    mesh.linear_colors = true;
    const Mesh again = reloaded(mesh, "o.gltf");
    REQUIRE(again.parts.size() == 2);
    CHECK(again.parts[0].name == "floor");
    CHECK(again.parts[1].name == "wall");
    CHECK(again.parts[1].material == 1);
    CHECK(again.materials[1].name == "glass");
    CHECK(again.materials[1].base_color == glm::vec4(0, 1, 0, 0.5f));
    CHECK(again.colors[8] == glm::vec4(0.25f, 1, 0, 1));
    const Json json = opened(saved(mesh, "o.glb")).json;
    CHECK(json["asset"]["generator"] == "goffer");
    const Json& primitives = json["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[0]["attributes"] == primitives[1]["attributes"]);
}

TEST_CASE("gltf made: a name that all parts share is the node's and the mesh's") {
    Mesh mesh = folded();
    mesh.parts[1].name = "floor";
    const Json json = opened(saved(mesh, "o.glb")).json;
    CHECK(json["nodes"][0]["name"] == "floor");
    CHECK(json["meshes"][0]["name"] == "floor");
    CHECK_FALSE(json["meshes"][0]["primitives"][0].contains("extras"));
}

TEST_CASE("gltf made: normals that are no direction become the face's, UVs that are no number 0") {
    Mesh mesh = folded();
    mesh.normals.values = {{0, 0, 0}, {0, 0, 0}};
    mesh.uvs[0].values[0] = {std::nanf(""), 1};
    mesh.tangents = {{{0, 0, 0, 0}, {3, 0, 0, -2}}, {0, 1, 0, 0, 0, 0, 0, Attribute<glm::vec4>::none}};
    const Mesh again = reloaded(mesh, "o.glb");
    for (const auto& [vertex, expected] :
         {std::pair{0, glm::vec3(0, 0, 1)}, std::pair{6, glm::vec3(-1, 0, 0)}}) {
        CHECK(again.normals.values[static_cast<std::size_t>(vertex)] == expected);
    }
    CHECK(again.uvs[0].values[0] == glm::vec2(0, 1));
    for (std::size_t i = 0; i < again.tangents.values.size(); ++i) {
        const glm::vec4& t = again.tangents.values[i];
        CHECK(glm::length(glm::vec3(t)) == doctest::Approx(1));
        if (i != 1) CHECK(glm::dot(glm::vec3(t), again.normals.values[i]) == doctest::Approx(0));
    }
    CHECK(again.tangents.values[1] == glm::vec4(1, 0, 0, -1));
}

TEST_CASE("gltf made: indices have 16 bits as long as these suffice") {
    for (const std::size_t count : {65535u, 65536u}) {
        Mesh mesh;
        for (std::size_t i = 0; i < count; ++i)
            mesh.positions.emplace_back(static_cast<float>(i), i % 2, i % 3);
        mesh.corners = {0, 1, static_cast<std::uint32_t>(count - 1)};
        mesh.faces = {3};
        const Json json = opened(saved(mesh, "o.glb")).json;
        const Json& indices =
            json["accessors"][json["meshes"][0]["primitives"][0]["indices"].get<std::size_t>()];
        CHECK(indices["componentType"] == (count == 65535 ? 5123 : 5125));
        CHECK(reloaded(mesh, "o.glb").corners == mesh.corners);
    }
}

TEST_CASE("gltf made: a name that is not UTF-8 does no harm") {
    Mesh mesh = folded();
    mesh.parts[0].name = "M\xfcller";
    CHECK(reloaded(mesh, "o.glb").parts[0].name == "M\xef\xbf\xbdller");
}
