// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>

#include <limits>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// A square of two triangles, 0 1 2 and 0 2 3, and a loose vertex 4; two normals, the first shared by
/// vertices 0 and 1.
Mesh square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
    mesh.corners = {0, 1, 2, 0, 2, 3};
    mesh.faces = {3, 3};
    mesh.normals.values = {{0, 0, 1}, {0, 0, 2}};
    mesh.normals.corners = {0, 0, 1, 1, 1, Attribute<glm::vec3>::none};
    return mesh;
}

}  // namespace

TEST_CASE("record i is vertex i with its first normal, further normals stand behind") {
    const VertexArrays r = vertex_arrays(square());
    REQUIRE(r.positions.size() == 6);
    CHECK(r.vertex == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 0});
    CHECK(r.positions[5] == glm::vec3(0, 0, 0));
    CHECK(r.normals ==
          std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 2}, {0, 0, 0}, {0, 0, 0}, {0, 0, 2}});
    CHECK(r.triangles == std::vector<std::uint32_t>{0, 1, 2, 5, 2, 3});
    CHECK(r.tangents.empty());
}

TEST_CASE("records put back unchanged give the same mesh") {
    const Mesh mesh = square();
    const Mesh back = with_vertex_arrays(mesh, vertex_arrays(mesh));
    CHECK(back.positions == mesh.positions);
    CHECK(back.normals == mesh.normals);
}

TEST_CASE("a normal that several vertices share is split only where they differ") {
    const Mesh mesh = square();
    VertexArrays bent = vertex_arrays(mesh);
    bent.positions[2] = {7, 7, 7};
    bent.normals[0] = {1, 0, 0};
    bent.normals[1] = {0, 1, 0};
    bent.normals[2] = bent.normals[5] = {0, 0, 5};
    const Mesh out = with_vertex_arrays(mesh, bent);
    CHECK(out.positions[2] == glm::vec3(7, 7, 7));
    CHECK(out.normals.values == std::vector<glm::vec3>{{1, 0, 0}, {0, 0, 5}, {0, 1, 0}});
    CHECK(out.normals.corners == std::vector<std::uint32_t>{0, 2, 1, 1, 1, Attribute<glm::vec3>::none});
}

TEST_CASE("normals per vertex and tangents go through, polygons are cut into fans") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3, 4};
    mesh.faces = {5};
    mesh.normals.values.assign(5, {0, 0, 1});
    mesh.tangents.values.assign(5, {1, 0, 0, -1});
    VertexArrays r = vertex_arrays(mesh);
    CHECK(triangle_count(mesh) == 3);
    CHECK(r.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4});
    CHECK(r.positions == mesh.positions);
    r.tangents[3] = {0, 1, 0, 1};
    r.normals[4] = {0, 1, 0};
    const Mesh out = with_vertex_arrays(mesh, r);
    CHECK(out.tangents.values[3] == glm::vec4(0, 1, 0, 1));
    CHECK(out.normals.values[4] == glm::vec3(0, 1, 0));
    CHECK(out.normals.per_vertex());
}

TEST_CASE("streams that the mesh lacks are ignored, streams that it needs are demanded") {
    Mesh mesh = square();
    VertexArrays bent = vertex_arrays(mesh);
    bent.tangents.assign(bent.positions.size(), glm::vec4(1));
    CHECK(with_vertex_arrays(mesh, bent).tangents.empty());
    bent.normals.pop_back();
    CHECK(error_of([&] { (void)with_vertex_arrays(mesh, bent); }).find("6 entries") != std::string::npos);
    mesh.normals = {};
    CHECK(with_vertex_arrays(mesh, bent).positions == mesh.positions);
}

TEST_CASE("a mesh that does not fit together is not written") {
    const Folder folder;
    const auto refused = [&](Mesh mesh, const std::string& what) {
        const std::string error = error_of([&] { save(mesh, folder / "x.ply"); });
        return tells(error, what) && folder.files() == 0;
    };
    Mesh mesh = square();
    mesh.positions[2].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(refused(mesh, "vertex 2"));
    mesh = square();
    mesh.normals.values[1].x = std::numeric_limits<float>::infinity();
    CHECK(refused(mesh, "normal 1"));
    mesh = square();
    mesh.corners[4] = 5;
    CHECK(refused(mesh, "corner 4: vertex index 5"));
    mesh = square();
    mesh.faces = {3, 2};
    CHECK(refused(mesh, "faces"));
    mesh = square();
    mesh.normals.corners[0] = 2;
    CHECK(refused(mesh, "normals"));
    mesh = square();
    mesh.colors.resize(2);
    CHECK(refused(mesh, "colors"));
    mesh = square();
    mesh.parts = {{.name = "", .material = 0, .first_face = 0, .face_count = 2}};
    CHECK(refused(mesh, "parts"));
    mesh = square();
    mesh.uvs.resize(1);
    mesh.uvs[0].values.resize(3);
    CHECK(refused(mesh, "texture"));
    CHECK(refused(Mesh{}, "no vertices"));
}
