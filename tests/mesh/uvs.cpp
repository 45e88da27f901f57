// SPDX-License-Identifier: MIT
#include "files.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

/// Vertex arrays that are split by texture coordinates too.

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// A cube whose sides are unfolded to a cross: 8 vertices, 14 texture coordinates, 6 normals.
const std::string cube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "vt 1 0\nvt 2 0\nvt 1 1\nvt 2 1\nvt 0 2\nvt 1 2\nvt 2 2\nvt 3 2\n"
    "vt 0 3\nvt 1 3\nvt 2 3\nvt 3 3\nvt 1 4\nvt 2 4\n"
    "vn 0 0 -1\nvn 0 0 1\nvn 0 -1 0\nvn 0 1 0\nvn -1 0 0\nvn 1 0 0\n";
const std::string cube_faces =
    "f 1/6/1 4/10/1 3/11/1 2/7/1\n"    // below, in the middle of the cross
    "f 1/6/3 2/7/3 6/4/3 5/3/3\n"      // front, under it
    "f 5/3/2 6/4/2 7/2/2 8/1/2\n"      // top, under the front
    "f 3/11/4 4/10/4 8/13/4 7/14/4\n"  // back, over it
    "f 4/10/5 1/6/5 5/5/5 8/9/5\n"     // left
    "f 2/7/6 3/11/6 7/12/6 6/8/6\n";   // right

/// Checks that every triangle's corners show what those of the mesh do, that entries follow the documented
/// order, and that no two are alike.
void check_arrays(const Mesh& mesh, const VertexArrays& arrays) {
    REQUIRE(arrays.uvs.size() == arrays.positions.size());
    REQUIRE(arrays.vertex.size() == arrays.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) REQUIRE(arrays.vertex[v] == v);
    const VertexArrays plain = vertex_arrays(mesh);
    REQUIRE(plain.triangles.size() == arrays.triangles.size());
    std::size_t wrong = 0, out_of_order = 0;
    std::uint32_t newest = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t c = 0; c < arrays.triangles.size(); ++c) {
        const std::uint32_t own = arrays.triangles[c], other = plain.triangles[c];
        wrong += arrays.positions[own] != plain.positions[other] ? 1 : 0;
        if (!plain.normals.empty()) wrong += arrays.normals[own] != plain.normals[other] ? 1 : 0;
        if (own > newest) ++out_of_order;
        if (own == newest) ++newest;
    }
    CHECK(wrong == 0);
    const bool only_triangles = std::ranges::all_of(mesh.faces, [](auto size) { return size == 3; });
    if (only_triangles) CHECK(out_of_order == 0);
    using Row = std::array<float, 8>;
    std::set<std::pair<std::uint32_t, Row>> rows;
    for (std::size_t i = 0; i < arrays.positions.size(); ++i) {
        const glm::vec3 n = arrays.normals.empty() ? glm::vec3(0) : arrays.normals[i];
        rows.insert({arrays.vertex[i], Row{n.x, n.y, n.z, arrays.uvs[i].x, arrays.uvs[i].y}});
    }
    if (mesh.normals.empty()) CHECK(rows.size() == arrays.positions.size());
}

/// Checks the texture coordinate of every corner of a mesh of triangles against the file's.
void check_uvs(const Mesh& mesh, const VertexArrays& arrays) {
    const Attribute<glm::vec2>& set = mesh.uvs[0];
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const std::uint32_t index = set.per_vertex() ? mesh.corners[c] : set.corners[c];
        const glm::vec2 truth = index == Attribute<glm::vec2>::none ? glm::vec2(0) : set.values[index];
        wrong += arrays.uvs[arrays.triangles[c]] != truth ? 1 : 0;
    }
    CHECK(wrong == 0);
}

void check_uvs_of_model(const char* name) {
    const auto file = model(name);
    if (file.empty()) return;
    const Mesh mesh = load(file);
    REQUIRE(!mesh.uvs.empty());
    const VertexArrays arrays = vertex_arrays_with_uvs(mesh);
    check_arrays(mesh, arrays);
    if (3 * mesh.faces.size() == mesh.corners.size()) check_uvs(mesh, arrays);
    CHECK(saved(with_vertex_arrays(mesh, arrays), name) ==
          saved(with_vertex_arrays(mesh, vertex_arrays(mesh)), name));
}

}  // namespace

TEST_CASE("uvs: a cube with seams has an entry for every normal and coordinate of a corner") {
    const Mesh mesh = load_text("cube.obj", cube + cube_faces);
    CHECK(vertex_arrays(mesh).positions.size() == 24);  // three sides at every vertex
    CHECK(vertex_arrays(mesh).uvs.empty());
    const VertexArrays arrays = vertex_arrays_with_uvs(mesh);
    CHECK(arrays.positions.size() == 24);
    check_arrays(mesh, arrays);
    const VertexArrays cut = vertex_arrays_with_uvs(mesh, 1);
    CHECK(cut.uvs.empty());
    CHECK(cut.triangles == vertex_arrays(mesh).triangles);
}

TEST_CASE("uvs: without normals a cube has an entry for every coordinate of a vertex") {
    Mesh mesh = load_text("cube.obj", cube + cube_faces);
    mesh.normals = {};
    CHECK(vertex_arrays(mesh).positions.size() == 8);
    const VertexArrays arrays = vertex_arrays_with_uvs(mesh);
    CHECK(arrays.positions.size() == 14);
    check_arrays(mesh, arrays);
    // The first face's corners come first; vertices 5..8 have the coordinates of the front and of the top.
    CHECK(arrays.uvs[0] == glm::vec2(1, 2));
    CHECK(arrays.uvs[4] == glm::vec2(1, 1));
    // Behind all vertices, in the order of use: the back's, the left's and the right's.
    CHECK(arrays.vertex == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 7, 6, 4, 7, 6, 5});
    CHECK(arrays.uvs[8] == glm::vec2(1, 4));
    CHECK(arrays.uvs[10] == glm::vec2(0, 2));
    CHECK(arrays.uvs[13] == glm::vec2(3, 2));
}

TEST_CASE("uvs: equal coordinates under several indices do not split, missing ones do") {
    const Mesh mesh =
        load_text("a.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 0\n"
                  "f 1/1 2/2 3/3\nf 1/4 3/3 4\nf 2/2 3 4\n");
    const VertexArrays arrays = vertex_arrays_with_uvs(mesh);
    CHECK(arrays.vertex == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2});
    CHECK(arrays.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 1, 5, 3});
    CHECK(arrays.uvs[4] == glm::vec2(0));
    check_arrays(mesh, arrays);
    check_uvs(mesh, arrays);
}

TEST_CASE("uvs: a result goes back into the mesh, one normal for each entry") {
    const Mesh mesh = load_text("cube.obj", cube + cube_faces);
    VertexArrays bent = vertex_arrays_with_uvs(mesh);
    for (glm::vec3& p : bent.positions) p = 2.0f * p + glm::vec3(1, 0, 0);
    for (glm::vec3& n : bent.normals) n = {n.y, n.z, n.x};
    const Mesh out = with_vertex_arrays(mesh, bent);
    CHECK(out.positions[0] == glm::vec3(-1, -2, -2));
    CHECK(out.normals.values[1] == glm::vec3(0, 1, 0));
    CHECK(out.normals.values.size() == 6);
    CHECK(out.uvs == mesh.uvs);
    bent.positions.pop_back();
    CHECK(error_of([&] { (void)with_vertex_arrays(mesh, bent); }).find("24 entries") != std::string::npos);
}

TEST_CASE("uvs: what only coordinates split goes back to its vertex, whose first entry counts") {
    Mesh mesh = load_text("cube.obj", cube + cube_faces);
    mesh.normals = {};
    mesh.normals.values = mesh.positions;  // one per vertex
    VertexArrays bent = vertex_arrays_with_uvs(mesh);
    REQUIRE(bent.positions.size() == 14);
    for (std::size_t i = 0; i < bent.positions.size(); ++i) {
        bent.positions[i] *= i < 8 ? 3.0f : 5.0f;
        bent.normals[i] *= i < 8 ? 0.5f : 0.25f;
    }
    const Mesh out = with_vertex_arrays(mesh, bent);
    for (std::size_t v = 0; v < 8; ++v) {
        CHECK(out.positions[v] == 3.0f * mesh.positions[v]);
        CHECK(out.normals.values[v] == 0.5f * mesh.positions[v]);
    }
    CHECK(out.normals.values.size() == 8);
    bent.positions.pop_back();
    CHECK(error_of([&] { (void)with_vertex_arrays(mesh, bent); }).find("14 entries") != std::string::npos);
    // By indices, each entry may have a normal of its own.
    mesh.normals.corners = mesh.corners;
    bent = vertex_arrays_with_uvs(mesh);
    for (std::size_t i = 8; i < 14; ++i) bent.normals[i] *= 0.25f;
    const Mesh split = with_vertex_arrays(mesh, bent);
    CHECK(split.normals.values.size() == 12);  // two of the six further ones are like another
    CHECK(vertex_arrays_with_uvs(split).normals == bent.normals);
}

TEST_CASE("uvs: blub_open.obj") {
    check_uvs_of_model("blub_open.obj");
}

TEST_CASE("uvs: wine_bottle.glb") {
    check_uvs_of_model("wine_bottle.glb");
}

TEST_CASE("uvs: log_01.glb") {
    check_uvs_of_model("log_01.glb");
}

TEST_CASE("uvs: banana.obj") {
    check_uvs_of_model("banana.obj");
}
