// SPDX-License-Identifier: MIT
#include "texture_mesh.hpp"

#include <utility>

namespace goffer::clip {
namespace {

/// The same parts, counted in triangles.
std::vector<mesh::Part> in_triangles(const mesh::Mesh& model) {
    std::vector<mesh::Part> parts = model.parts;
    const std::vector<mesh::TriangleRange> triangles = mesh::triangles_of_parts(model);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].first_face = triangles[i].first;
        parts[i].face_count = triangles[i].count;
    }
    return parts;
}

}  // namespace

mesh::Mesh texture_mesh(const mesh::Mesh& model, const mesh::VertexArrays& arrays) {
    const std::size_t count = arrays.positions.size();
    mesh::Mesh result;
    result.positions = arrays.positions;
    result.normals.values = arrays.normals;
    result.uvs.resize(2);
    result.uvs[0].values = arrays.uvs;
    result.uvs[0].values.resize(count, glm::vec2(0.0f, 1.0f));
    result.uvs[1].values.reserve(count);
    // glTF's v is 1 - v: there it is 0.
    for (std::size_t i = 0; i < count; ++i) result.uvs[1].values.emplace_back(static_cast<float>(i), 1.0f);
    if (!model.colors.empty()) {
        result.colors.reserve(count);
        for (const std::uint32_t vertex : arrays.vertex) result.colors.push_back(model.colors[vertex]);
        result.linear_colors = model.linear_colors;
    }
    result.corners = arrays.triangles;
    result.faces.assign(arrays.triangles.size() / 3, 3);
    result.parts = in_triangles(model);
    result.materials = model.materials;
    return result;
}

}  // namespace goffer::clip
