// SPDX-License-Identifier: MIT
#include "mesh/gltf_files.hpp"
#include "mesh/refined.hpp"
#include "starve.hpp"

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

constexpr const char* endings[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};

/// The parser of JSON copies and destroys trees in functions that must not throw, and allocates there: it
/// ends the program where that fails. For a glTF, therefore, only allocations as large as those for its
/// numbers are refused.
Diet diet_of(const std::string& ending) {
    return {.least = ending == ".gltf" || ending == ".glb" ? 2000u : 0u, .most = 300};
}

/// With normals, tangents, texture coordinates and a material; 256 triangles, so that their numbers take more
/// than any list of a JSON has.
Mesh subject() {
    Mesh mesh = load_document(tetra());
    for (int i = 0; i < 3; ++i) mesh = refined(mesh, halves(mesh).pieces());
    mesh.source = nullptr;
    mesh.materials.push_back({.name = "skin"});
    for (Part& part : mesh.parts) part.material = 0;
    return mesh;
}

/// Whether a file is as it was before, or as it is to be, and nothing lies beside these.
void require_whole(const Folder& folder, const std::filesystem::path& file, const std::string& before,
                   const std::string& written) {
    const std::string bytes = bytes_of(file);
    CHECK((bytes == before || bytes == written));
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
        CHECK(entry.path().stem() == file.stem());
}

void starve_save(const Mesh& mesh, const std::string& ending) {
    CAPTURE(ending);
    const Folder folder;
    const std::string written = saved(mesh, "out" + ending), before = "what was there";
    const auto file = folder.write("out" + ending, before);
    const auto after = [&] {
        require_whole(folder, file, before, written);
        folder.write("out" + ending, before);
    };
    starve<Error>([&] { save(mesh, file); }, after, diet_of(ending));
}

}  // namespace

TEST_CASE("loading any format without it ends in an error") {
    for (const std::string ending : endings) {
        CAPTURE(ending);
        const Folder folder;
        save(subject(), folder / ("in" + ending));
        starve<Error>([&] { (void)load(folder / ("in" + ending)); }, diet_of(ending));
    }
}

TEST_CASE("loading text of a PLY and an STL without it ends in an error") {
    const Folder folder;
    const auto ply = folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const auto stl = folder.write("a.stl",
                                  "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                  "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    for (const auto& file : {ply, stl}) starve<Error>([&] { (void)load(file); });
}

TEST_CASE("a mesh that is saved without it leaves the file as it was, and nothing beside it") {
    for (const std::string ending : endings) starve_save(subject(), ending);
}

TEST_CASE("a file that is given back, bent, without it leaves the file as it was") {
    for (const std::string ending : endings) {
        Mesh mesh = reloaded(subject(), "in" + ending);
        for (glm::vec3& position : mesh.positions) position.x += 1;
        starve_save(mesh, ending);
    }
}

TEST_CASE("arrays of a mesh, and a refined mesh, are made or are not") {
    for (const std::string ending : endings) {
        CAPTURE(ending);
        const Mesh mesh = reloaded(subject(), "in" + ending);
        starve<Error>([&] { (void)with_vertex_arrays(mesh, vertex_arrays_with_uvs(mesh)); }, {.most = 300});
        const MeshRecipe made = halves(mesh);
        starve<Error>([&] { (void)refined(mesh, made.pieces()); }, diet_of(ending));
    }
}
