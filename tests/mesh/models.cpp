// SPDX-License-Identifier: MIT
#include "support/models.hpp"

#include "files.hpp"
#include "same.hpp"

#include <doctest/doctest.h>
#include <tiny_obj_loader.h>

#include <cstring>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// Every vertex a little further up, every normal turned.
Mesh moved(const Mesh& mesh) {
    VertexArrays r = vertex_arrays(mesh);
    for (std::size_t i = 0; i < r.positions.size(); ++i) {
        r.positions[i] = r.positions[i] * 1.37f + glm::vec3(0, 0, 1e-3f * static_cast<float>(i % 17));
        if (!r.normals.empty())
            r.normals[i] = {r.normals[i].y, r.normals[i].z, 1e-5f * static_cast<float>(i)};
    }
    return with_vertex_arrays(mesh, r);
}

/// As tinyobjloader reads it.
void check_against_library(const Mesh& mesh, const std::filesystem::path& file) {
    tinyobj::ObjReader reader;
    tinyobj::ObjReaderConfig config;
    config.triangulate = false;
    REQUIRE(reader.ParseFromFile(file.string(), config));
    const tinyobj::attrib_t& all = reader.GetAttrib();
    REQUIRE(all.vertices.size() == 3 * mesh.positions.size());
    // It rounds numbers in its own way: the last bit may differ.
    double worst = 0;
    for (std::size_t i = 0; i < all.vertices.size(); ++i)
        worst = std::max<double>(worst,
                                 std::abs(all.vertices[i] - mesh.positions[i / 3][static_cast<int>(i % 3)]));
    CHECK(worst < 1e-6);
    std::size_t corner = 0, wrong = 0;
    for (const tinyobj::shape_t& shape : reader.GetShapes())
        for (const tinyobj::index_t& index : shape.mesh.indices) {
            wrong += static_cast<int>(mesh.corners[corner]) != index.vertex_index;
            if (!mesh.normals.empty())
                wrong += static_cast<int>(mesh.normals.corners[corner]) != index.normal_index;
            if (!mesh.uvs.empty())
                wrong += static_cast<int>(mesh.uvs[0].corners[corner]) != index.texcoord_index;
            ++corner;
        }
    CHECK(corner == mesh.corners.size());
    CHECK(wrong == 0);
}

/// Read with the right counts, an OBJ as tinyobjloader reads it, and written back to the byte; moved, written
/// and read again, all is as it was.
void check_kept_model(const char* name, std::size_t vertices, std::size_t triangles) {
    const auto file = model(name);
    if (file.empty()) return;
    const Mesh mesh = load(file);
    CHECK(mesh.positions.size() == vertices);
    CHECK(triangle_count(mesh) == triangles);
    CHECK(saved(with_vertex_arrays(mesh, vertex_arrays(mesh)), name) == bytes_of(file));
    if (file.extension() == ".obj") check_against_library(mesh, file);
    const Mesh other = moved(mesh);
    check_same(reloaded(other, name), other);
}

}  // namespace

TEST_CASE("models: banana.obj") {
    check_kept_model("banana.obj", 8194, 16384);
}

TEST_CASE("models: koala.obj") {
    check_kept_model("koala.obj", 49999, 99994);
}

TEST_CASE("models: blub_open.obj") {
    check_kept_model("blub_open.obj", 5857, 11648);
}

TEST_CASE("models: softball.obj") {
    check_kept_model("softball.obj", 8194, 16384);
}

TEST_CASE("models: fuze.ply") {
    check_kept_model("fuze.ply", 502, 1000);
}

TEST_CASE("models: l_arista.stl") {
    check_kept_model("l_arista.stl", 163128, 54376);
}

TEST_CASE("models: lh_trochanterfemur.stl") {
    check_kept_model("lh_trochanterfemur.stl", 9948, 3316);
}

TEST_CASE("models: banana.obj, moved and written, keeps all lines but positions and normals") {
    const auto file = model("banana.obj");
    if (file.empty()) return;
    const auto others = [](const std::string& text) {
        std::string out;
        for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
            end = text.find('\n', at);
            if (text.compare(at, 2, "v ") != 0 && text.compare(at, 2, "vn") != 0)
                out += text.substr(at, end - at);
        }
        return out;
    };
    const Mesh mesh = load(file);
    CHECK(mesh.uvs[0].values.size() == 8368);
    CHECK(mesh.normals.values.size() == 8194);
    CHECK(mesh.materials.size() == 1);
    CHECK(mesh.warnings.size() == 1);
    CHECK(others(saved(moved(mesh), "a.obj")) == others(bytes_of(file)));
}

TEST_CASE("models: fuze.ply, moved and written, keeps all bytes but positions") {
    const auto file = model("fuze.ply");
    if (file.empty()) return;
    const Mesh mesh = load(file);
    CHECK(mesh.colors.size() == 502);
    REQUIRE(mesh.uvs.size() == 1);
    CHECK(mesh.uvs[0].values.size() == 3000);
    const std::string before = bytes_of(file), after = saved(moved(mesh), "a.ply");
    REQUIRE(after.size() == before.size());
    const std::size_t body = before.find("end_header\n") + 11;
    CHECK(after.substr(0, body) == before.substr(0, body));
    std::size_t different = 0;
    for (std::size_t i = body; i < before.size(); ++i)
        different += before[i] != after[i] && (i >= body + 502 * 16 || (i - body) % 16 >= 12);
    CHECK(different == 0);
}

TEST_CASE("models: lh_trochanterfemur.stl keeps header and attribute bytes") {
    const auto file = model("lh_trochanterfemur.stl");
    if (file.empty()) return;
    const std::string before = bytes_of(file), after = saved(moved(load(file)), "a.stl");
    REQUIRE(after.size() == before.size());
    CHECK(after.substr(0, 84) == before.substr(0, 84));
    for (std::size_t f = 0; f < 3316; ++f)
        REQUIRE(after.compare(84 + 50 * f + 48, 2, before, 84 + 50 * f + 48, 2) == 0);
}
