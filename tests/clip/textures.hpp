// SPDX-License-Identifier: MIT
#pragma once

#include "moving.hpp"
#include "support/angles.hpp"
#include "support/files.hpp"

#include <goffer/clip/vertex_texture.hpp>
#include <goffer/io/atomic_file.hpp>

#include <algorithm>
#include <cmath>

/// Vertex-animation textures that were written, and how far off what they say is.

namespace goffer::test {

inline clip::VertexTexture saved_texture(clip::Frames& frames, const mesh::Mesh& model,
                                         const mesh::VertexArrays& arrays, const std::filesystem::path& file,
                                         clip::TexturePlacement placement = clip::TexturePlacement::baked) {
    io::AtomicFiles files;
    clip::VertexTexture texture = clip::save_vertex_texture(frames, model, arrays, file, files, placement);
    files.commit();
    return texture;
}

/// A strip of triangles, for points that have none: what is drawn of them does not matter.
inline mesh::Mesh strip(std::size_t vertices) {
    mesh::Mesh mesh;
    mesh.positions.assign(vertices, glm::vec3(0.0f));
    for (std::uint32_t i = 0; i + 2 < vertices; ++i) {
        mesh.positions[i] = {i, i % 2, 0};
        mesh.corners.insert(mesh.corners.end(), {i, i + 1, i + 2});
        mesh.faces.push_back(3);
    }
    return mesh;
}

/// The largest difference on any axis.
inline double farthest(const glm::dvec3& a, const glm::dvec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// What a decoder in float arithmetic may add to half a step: three roundings of numbers as large as these.
inline double float_rounding(const clip::VertexTexture& texture) {
    const glm::vec3 largest = glm::max(glm::abs(texture.low), glm::abs(texture.high));
    return 3.0 * 0x1p-24 * static_cast<double>(std::max({largest.x, largest.y, largest.z}));
}

/// What 16 bits on each axis may turn a unit normal by: half a step of 2 / 65535 on three axes.
inline constexpr double normal_half_step = 1.7320508 / 65535 * 57.29577951308232;

}  // namespace goffer::test
