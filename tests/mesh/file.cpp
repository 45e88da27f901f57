// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <goffer/io/error.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>

using namespace goffer::mesh;
using namespace goffer::test;

namespace fs = std::filesystem;

namespace {

/// Two quads in two parts of two materials, with normals, uvs, all of them per vertex, and colors.
Mesh made() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(0.1f * static_cast<float>(i % 4), i / 4, 0.3f);
        mesh.normals.values.emplace_back(0, 0, i % 2 == 0 ? 1 : -1);
        mesh.colors.emplace_back(0.2f, 0.4f, 0.6f, 1);
    }
    mesh.uvs.resize(1);
    for (const glm::vec3& p : mesh.positions) mesh.uvs[0].values.emplace_back(p.x, 0.25f * p.y);
    mesh.corners = {0, 1, 5, 4, 2, 3, 7, 6};
    mesh.faces = {4, 4};
    mesh.materials = {{"red", {1, 0, 0, 1}}, {"half blue", {0, 0, 1, 0.5f}}};
    mesh.parts = {{"left", 0, 0, 1}, {"right", 1, 1, 1}};
    return mesh;
}

/// The positions of the triangles' corners, which every format keeps, in its order.
std::vector<glm::vec3> soup(const Mesh& mesh) {
    std::vector<glm::vec3> out;
    const VertexArrays r = vertex_arrays(mesh);
    for (const std::uint32_t i : r.triangles) out.push_back(r.positions[i]);
    return out;
}

}  // namespace

TEST_CASE("file: what is no readable file is refused, and named") {
    const Folder folder;
    const auto error = [&](const fs::path& file, const std::string& what) {
        return tells(error_of([&] { (void)load(file); }), what);
    };
    CHECK(error(folder / "none.obj", "none.obj: there is no such file"));
    CHECK(error(folder / "none/none.obj", "there is no such file"));
    CHECK(error(folder / "", "is a folder"));
    CHECK(error(folder.write("a.obj", ""), "a.obj: is empty"));
    CHECK(error(folder.write("a.xyz", "1 2 3"), "a.xyz: neither the content nor the ending"));
    fs::create_symlink("/dev/zero", folder / "zero.obj");
    CHECK(error(folder / "zero.obj", "is not a regular file"));
    const std::string garbage("\x01\x80\xff\x00\x7f\x13 v f", 9);
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf", "a"})
        CHECK(error(folder.write(name, garbage), name));
}

TEST_CASE("file: content counts before the ending") {
    const Mesh mesh = made();
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf"}) {
        const Folder folder;
        save(mesh, folder / name);
        fs::rename(folder / name, folder / "b.OBJ");
        CHECK(soup(load(folder / "b.OBJ")) == soup(mesh));
        fs::rename(folder / "b.OBJ", folder / "b");
        CHECK(soup(load(folder / "b")) == soup(mesh));
    }
    CHECK(load_text("a.xyz", "# from somewhere\n\n  " + triangle_obj).positions.size() == 3);
    CHECK(tells(load_error("a.xyz", "solid ground\nendsolid ground\n"), "no facets"));
    CHECK(tells(load_error("a.xyz", "solid ground\nis words\n"), "neither the content nor the ending"));
}

TEST_CASE("file: endings that can be written, in any case") {
    for (const char* name : {"a.obj", "a.PLY", "b/a.b.Stl", "a.glb", "a.gltf"}) CHECK(can_save(name));
    for (const char* name : {"a", "obj", ".obj", "a.obj.gz", "a.fbx", ""}) CHECK(!can_save(name));
    const Folder folder;
    const std::string error = error_of([&] { save(made(), folder / "a.fbx"); });
    CHECK(tells(error, ".obj, .ply, .stl, .glb or .gltf"));
    CHECK(folder.files() == 0);
}

TEST_CASE("file: every format goes into every other") {
    const std::array names{"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf"};
    const Mesh mesh = made();
    for (const std::string from : names) {
        const Mesh first = reloaded(mesh, from);
        for (const std::string to : names) {
            CAPTURE(from);
            CAPTURE(to);
            const Mesh second = reloaded(first, to);
            const bool is_soup = from == "a.stl" || to == "a.stl";
            const bool has_materials = !is_soup && from != "a.ply" && to != "a.ply";
            const bool mtl_is_gone = from == "a.obj" && to == "a.obj";  // with the folder that it was in
            CHECK(soup(second) == soup(mesh));
            CHECK(second.normals.empty() == is_soup);
            CHECK(second.uvs.empty() == is_soup);
            CHECK(second.colors.empty() == is_soup);
            // The light of the sRGB values 0.2, 0.4 and 0.6.
            const bool linear = to == "a.glb" || to == "a.gltf";
            const glm::vec3 color =
                linear ? glm::vec3(0.033105f, 0.132868f, 0.318547f) : glm::vec3(0.2f, 0.4f, 0.6f);
            if (!is_soup) {
                CHECK(second.linear_colors == linear);
                CHECK(glm::distance(glm::vec3(second.colors[0]), color) < 1e-4f);
            }
            REQUIRE(second.materials.size() == (has_materials ? 2 : 0));
            if (!has_materials) continue;
            if (!mtl_is_gone) CHECK(second.materials == mesh.materials);
            CHECK(second.parts.size() == 2);
        }
    }
}

TEST_CASE("file: texture coordinates come back as they were written") {
    const Mesh mesh = made();
    for (const std::string name : {"a.obj", "a.ply", "a.glb", "a.gltf"}) {
        CAPTURE(name);
        const Mesh again = reloaded(mesh, name);
        REQUIRE(again.uvs.size() == 1);
        const auto& uvs = again.uvs[0];
        for (std::size_t c = 0; c < again.corners.size(); ++c) {
            const std::uint32_t vertex = again.corners[c];
            const glm::vec2 uv = uvs.values[uvs.per_vertex() ? vertex : uvs.corners[c]];
            CHECK(uv.x == doctest::Approx(again.positions[vertex].x));
            CHECK(uv.y == doctest::Approx(0.25f * again.positions[vertex].y));
        }
    }
}

TEST_CASE("file: a new OBJ gets its materials beside it, an old one keeps its own") {
    const Folder folder;
    save(made(), folder / "a.obj");
    CHECK(folder.files() == 2);
    CHECK(bytes_of(folder / "a.mtl").find("newmtl half blue\nKd 0 0 1\nd 0.5\n") != std::string::npos);
    save(load(folder / "a.obj"), folder / "b.obj");
    CHECK(folder.files() == 3);
    CHECK(bytes_of(folder / "b.obj") == bytes_of(folder / "a.obj"));
}

TEST_CASE("file: an output that cannot be written is refused, and what was there stays") {
    const Folder folder;
    const Mesh mesh = made();
    const auto error = [&](const fs::path& file, const std::string& what) {
        const std::string message = message_of<goffer::io::Error>([&] { save(mesh, file); });
        INFO(message);
        return tells(message, what);
    };
    CHECK(error(folder / "none/a.stl", "there is no such folder"));
    fs::create_directory(folder / "a.stl");
    CHECK(error(folder / "a.stl", "is a folder"));
    fs::create_symlink("/dev/full", folder / "full.ply");
    const std::string full = message_of<goffer::io::Error>([&] { save(mesh, folder / "full.ply"); });
    CHECK(full.find("/dev/full: is not a regular file") == 0);
    CHECK(error(folder / (std::string(252, 'x') + ".ply"), "its name is too long"));
    CHECK(folder.files() == 2);
}

TEST_CASE("file: when the disk is full nothing is left behind and the old file stays") {
    const Folder folder;
    folder.write("a.stl", "old");
    Mesh mesh = made();
    for (int i = 0; i < 4000; ++i) {
        mesh.faces.push_back(3);
        mesh.corners.insert(mesh.corners.end(), {0, 1, 2});
    }
    mesh.parts.clear();
    const std::string message = message_of<goffer::io::Error>([&] {
        const FullDisk full(1 << 16);
        save(mesh, folder / "a.stl");
    });
    CHECK(tells(message, "a.stl: cannot be written: File too large"));
    CHECK(bytes_of(folder / "a.stl") == "old");
    CHECK(folder.files() == 1);
}
