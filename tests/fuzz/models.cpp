// SPDX-License-Identifier: MIT
#include "mesh/files.hpp"
#include "mesh/refined.hpp"
#include "require.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

/// A file of any format, told by its content: what loads is given back, bent and refined, and written in
/// another format, and each of these loads. The bytes are the file's, so that a find is a model. It is called
/// model.obj: an OBJ that names a file of this name finds its materials in itself, and what no format knows
/// is read as OBJ.

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

constexpr const char* endings[] = {".obj", ".ply", ".stl", ".glb", ".gltf"};

const Folder& folder() {
    static const Folder folder;
    return folder;
}

void require_finite(const Mesh& mesh) {
    for (const glm::vec3& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) require(std::isfinite(p[i]), "positions are finite");
    }
    for (const std::uint32_t vertex : mesh.corners)
        require(vertex < mesh.positions.size(), "corners are vertices");
}

/// Writes and reads `mesh`. Some meshes cannot be written; what was written can be read.
void round_trip(const Mesh& mesh, const std::string& ending) {
    const auto file = folder() / ("out" + ending);
    try {
        save(mesh, file);
    } catch (const Error& error) {
        return require_one_line(error.what());
    }
    const Mesh again = load(file);
    require_finite(again);
    require(triangle_count(again) == triangle_count(mesh), "a file that was written has all triangles");
    std::filesystem::remove(file);
}

/// Textures are on all corners or on none, and their images are bytes or an error.
void look_at_textures(const Mesh& mesh) {
    const std::size_t corners = texture_uvs(mesh).size();
    require(corners == 0 || corners == 3 * triangle_count(mesh), "all corners have a place in a texture");
    for (const Material& material : mesh.materials) {
        if (!material.texture) continue;
        try {
            (void)material.texture->image->bytes();
        } catch (const Error& error) {
            require_one_line(error.what());
        }
    }
}

/// Turned, which keeps numbers finite.
Mesh bent(const Mesh& mesh) {
    VertexArrays arrays = vertex_arrays(mesh);
    for (glm::vec3& p : arrays.positions) p = {p.y, p.z, p.x};
    for (glm::vec3& n : arrays.normals) n = {n.y, n.z, n.x};
    (void)vertex_arrays_with_uvs(mesh, mesh.uvs.empty() ? 0 : mesh.uvs.size() - 1);
    return with_vertex_arrays(mesh, arrays);
}

/// Nothing where a glTF has at fault what nothing but refining reads, such as weights of joints.
std::optional<Mesh> halved(const Mesh& mesh) {
    try {
        return refined(mesh, halves(mesh).pieces());
    } catch (const Error& error) {
        require_one_line(error.what());
        return std::nullopt;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const auto file = folder().write("model.obj", bytes);
    Mesh mesh;
    try {
        mesh = load(file);
    } catch (const Error& error) {
        require_one_line(error.what());
        return 0;
    }
    require_finite(mesh);
    look_at_textures(mesh);
    // Which format depends on the size, so that every mutation that changes it tries others.
    round_trip(mesh, endings[size % std::size(endings)]);
    round_trip(bent(mesh), endings[size / 5 % std::size(endings)]);
    if (const auto cut = halved(mesh)) round_trip(*cut, endings[size / 7 % std::size(endings)]);
    return 0;
}
