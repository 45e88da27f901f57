// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"

#include <goffer/mesh/refined.hpp>

#include <doctest/doctest.h>

#include <array>
#include <limits>

/// A small file can stand for a large mesh: what is beyond the limits is refused before it is allocated.

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();

/// What loading says within `limits`.
std::string within(const Limits& limits, const std::string& name, const std::string& bytes) {
    const Folder folder;
    const auto file = folder.write(name, bytes);
    return error_of([&] { (void)load(file, {.limits = limits}); });
}

/// A strip of triangles.
Mesh strip(std::uint32_t triangles) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles + 2; ++i)
        mesh.positions.emplace_back(0.5f * static_cast<float>(i), i % 2, 0);
    for (std::uint32_t t = 0; t < triangles; ++t) mesh.corners.insert(mesh.corners.end(), {t, t + 1, t + 2});
    mesh.faces.assign(triangles, 3);
    return mesh;
}

/// Nodes that all show the same mesh.
Document repeated(Document document, std::size_t nodes) {
    document.json["nodes"] = Json::array();
    document.json["scenes"][0]["nodes"] = Json::array();
    for (std::size_t i = 0; i < nodes; ++i) {
        document.json["nodes"].push_back({{"mesh", 0}});
        document.json["scenes"][0]["nodes"].push_back(i);
    }
    return document;
}

}  // namespace

TEST_CASE("limits: numbers of vertices and triangles, in every format") {
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf"}) {
        CAPTURE(name);
        const std::string bytes = saved(strip(100), name);
        const std::uint64_t vertices = name == std::string("a.stl") ? 300 : 102;
        CHECK(within({.memory = any, .vertices = vertices, .triangles = 100}, name, bytes).empty());
        CHECK(tells(within({.vertices = vertices - 1}, name, bytes), "Limits::vertices"));
        CHECK(tells(within({.triangles = 99}, name, bytes), "has more than 99 triangles"));
    }
}

TEST_CASE("limits: memory, which is named with the option, in every format") {
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf"}) {
        CAPTURE(name);
        const std::string bytes = saved(strip(1000), name);
        CHECK(within({.memory = 1 << 21}, name, bytes).empty());
        const std::string message = within({.memory = 1 << 14}, name, bytes);
        CHECK(tells(message, "takes more than the 16 KiB of memory"));
        CHECK(tells(message, "--max-memory of the command, Limits::memory in a program"));
        CHECK(tells(within({.memory = bytes.size() - 1}, name, bytes), "Limits::memory"));
    }
}

TEST_CASE("limits: a PLY is kept as it is, and counts once more") {
    const std::string bytes = saved(strip(10), "a.ply") + std::string(100000, ' ');
    CHECK(within({.memory = 220000}, "a.ply", bytes).empty());
    CHECK(tells(within({.memory = 180000}, "a.ply", bytes), "Limits::memory"));
}

TEST_CASE("limits: faces of a PLY count, however few vertices they share") {
    constexpr std::size_t faces = 20000;
    std::string bytes =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face " +
        std::to_string(faces) +
        "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    for (std::size_t f = 0; f < faces; ++f) bytes += f % 2 == 0 ? "3 0 1 2\n" : "3 0 2 3\n";
    // The file itself, read and kept; three corners and the size of each face, at the least.
    const std::size_t least = 2 * bytes.size() + faces * 4 * sizeof(std::uint32_t);
    CHECK(tells(within({.memory = least}, "a.ply", bytes), "Limits::memory"));
    CHECK(within({.memory = 4 * least}, "a.ply", bytes).empty());
}

TEST_CASE("limits: faces of an OBJ count, however few vertices they share") {
    constexpr std::size_t faces = 20000;
    std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (std::size_t f = 0; f < faces; ++f) bytes += "f 1 2 3\n";
    // The text; of each face its size, and of each corner a vertex, a uv and a normal, read and kept.
    const std::size_t least = bytes.size() + faces * (1 + 2 * 3 * 3) * sizeof(std::uint32_t);
    CHECK(tells(within({.memory = least}, "a.obj", bytes), "Limits::memory"));
    CHECK(within({.memory = 4 * least}, "a.obj", bytes).empty());
}

TEST_CASE("limits: what an attribute is read into stays while the others are read") {
    Mesh mesh = strip(9000);
    const std::string plain = saved(mesh, "a.glb");
    mesh.normals.values.assign(mesh.positions.size(), {0, 0, 1});
    mesh.tangents.values.assign(mesh.positions.size(), {1, 0, 0, 1});
    const std::string bytes = saved(mesh, "a.glb");
    CHECK(within({.memory = 1'200'000}, "a.glb", plain).empty());
    CHECK(tells(within({.memory = 1'700'000}, "a.glb", bytes), "Limits::memory"));
    CHECK(within({.memory = 2'400'000}, "a.glb", bytes).empty());
}

TEST_CASE("limits: triangles of strips and fans count as others do") {
    for (const int mode : {5, 6}) {
        Document document = tetra();
        Json& primitive = primitive_of(document);
        primitive["mode"] = mode;
        std::vector<std::uint16_t> indices(30000);
        for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint16_t>(i % 4);
        primitive["indices"] = document.shorts(indices);
        const std::size_t bytes = document.glb().size();
        CHECK(within({.memory = bytes + 1'600'000}, "d.glb", document.glb()).empty());
        // A corner is read into a number; a triangle has three, and its size.
        CHECK(tells(within({.memory = bytes + 800'000}, "d.glb", document.glb()), "Limits::memory"));
    }
}

TEST_CASE("limits: elements that no bytes are behind count in the scene, not in each accessor") {
    Document document = tetra();
    document.json["accessors"][0] = {{"componentType", 5126}, {"count", 1 << 20}, {"type", "VEC3"}};
    primitive_of(document) = {{"attributes", {{"POSITION", 0}}}};
    CHECK(within({}, "d.glb", repeated(document, 1).glb()).empty());
    CHECK(tells(within({}, "d.glb", repeated(document, 2).glb()), "1048576 elements without a bufferView"));
}

TEST_CASE("limits: a mesh that is repeated, a buffer that is named again and again, and much JSON") {
    const Folder folder;
    const Limits small{.memory = 1 << 20};
    CHECK(within(small, "d.glb", repeated(tetra(), 10).glb()).empty());
    CHECK(tells(within(small, "d.glb", repeated(tetra(), 5000).glb()), "Limits::memory"));

    Document document = tetra();
    folder.write("large.bin", document.buffer + std::string(100000, '\0'));
    for (int i = 0; i < 100; ++i)
        document.json["buffers"].push_back({{"byteLength", 100000}, {"uri", "large.bin"}});
    const auto file = folder.write("d.gltf", document.gltf());
    CHECK(load(file).positions.size() == 4);
    CHECK(tells(error_of([&] { (void)load(file, {.limits = small}); }), "Limits::memory"));

    document = tetra();
    document.json["meshes"][0]["extras"] = std::vector<Json>(100, {{"a", 0}});
    CHECK(within(small, "d.glb", repeated(document, 10).glb()).empty());
    CHECK(tells(within(small, "d.glb", repeated(document, 50).glb()), "Limits::memory"));

    // Each part keeps its name, which may be that of the node.
    document = tetra();
    document.json["nodes"][0]["name"] = std::string(20000, 'n');
    CHECK(within(small, "d.glb", document.glb()).empty());
    const Json primitive = primitive_of(document);
    document.json["meshes"][0]["primitives"] = std::vector<Json>(30, primitive);
    CHECK(tells(within(small, "d.glb", document.glb()), "Limits::memory"));
    document.json["nodes"][0]["name"] = "n";
    CHECK(within(small, "d.glb", document.glb()).empty());

    // A node's mesh may be written for it alone: it counts again, though it is shown once.
    for (const Json& much : {Json(std::vector<Json>(4000, {{"a", 0}})),
                             Json(std::vector<Json>(6500, Json::array())), Json(std::string(300000, 'x'))}) {
        document = tetra();
        document.json["extras"] = much;
        CHECK(within(small, "d.glb", document.glb()).empty());
        document = tetra();
        document.json["meshes"][0]["extras"] = much;
        CHECK(tells(within(small, "d.glb", document.glb()), "Limits::memory"));
    }
    document = tetra();
    document.json["meshes"][0]["extras"] = std::string(10000, 'x');
    CHECK(within(small, "d.glb", document.glb()).empty());

    document = tetra();
    document.json["extras"] = std::vector<Json>(50000, Json::array());
    CHECK(tells(within(small, "d.gltf", document.gltf()), "Limits::memory"));
}

TEST_CASE("limits: members of the JSON's objects, each of which is looked up among all before it") {
    const auto with_members = [](int count) {
        Document document = tetra();
        for (int i = 0; i < count; ++i) document.json["extras"]["k" + std::to_string(i)] = 0;
        return load_error("d.gltf", document.gltf());
    };
    CHECK(with_members(3000).empty());
    CHECK(tells(with_members(40000), "objects of too many members"));
}

TEST_CASE("limits: materials of an OBJ, used and unused") {
    const Folder folder;
    std::string names, text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (int i = 0; i < 1000; ++i) names += "newmtl m\n";
    folder.write("a.mtl", names);
    const auto file = folder.write("a.obj", text);
    CHECK(load(file).warnings.empty());
    CHECK(tells(error_of([&] { (void)load(file, {.limits = {.memory = 1 << 18}}); }), "Limits::memory"));
}

TEST_CASE("limits: a refined mesh") {
    const Mesh mesh = strip(2);
    const std::array<EdgeVertex, 1> cut{{{1, 2, 0.5}}};
    const std::array<std::uint32_t, 12> pieces{0, 1, 4, 0, 4, 2, 1, 3, 4, 4, 3, 2};
    const std::array<std::uint32_t, 4> parents{0, 0, 1, 1};
    const auto message = [&](const Limits& limits) {
        return error_of([&] { (void)refined(mesh, {cut, pieces, parents}, limits); });
    };
    CHECK(message({.vertices = 5, .triangles = 4}).empty());
    CHECK(message({.vertices = 4}).find("more than 4 vertices") != std::string::npos);
    CHECK(message({.triangles = 3}).find("more than 3 triangles") != std::string::npos);
    CHECK(message({.memory = 100}).find("Limits::memory") != std::string::npos);
}
