// SPDX-License-Identifier: MIT
#pragma once

#include "clips.hpp"
#include "played.hpp"
#include "support/files.hpp"

#include <goffer/clip/gltf.hpp>
#include <goffer/io/atomic_file.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>
#include <vector>

/// Whether a file shows what the frames are.

namespace goffer::test {

inline clip::GltfReport saved_clip(const mesh::Mesh& mesh, clip::Frames& frames,
                                   const std::filesystem::path& file, const clip::GltfOptions& options = {}) {
    io::AtomicFiles files;
    clip::GltfReport report = clip::save_gltf(mesh, frames, options, file, files);
    files.commit();
    CHECK(report.bytes == std::filesystem::file_size(file));
    CHECK(report.frames == frames.count());
    CHECK(report.rms_error <= report.max_error);
    CHECK(report.rms_angle <= report.max_angle);
    return report;
}

/// What is largest of distances and angles, in all frames and at all corners of all faces.
struct Off {
    double distance = 0, angle = 0;
};

/// Compares corner by corner: faces come in the same order, whatever vertices a file has.
inline Off off_at(const Player& player, const mesh::Mesh& mesh, clip::Frames& frames, std::size_t frame) {
    const mesh::VertexArrays arrays = mesh::vertex_arrays(mesh);
    std::vector<glm::vec3> positions(arrays.positions.size()), normals(arrays.normals.size());
    frames.read(frame, positions, normals);
    const glm::dmat4x3 placement(frames.placement(frame));
    Off off;
    std::size_t corner = 0;
    for (const PlayedPrimitive& played : player.at(static_cast<double>(frame) / frames.rate())) {
        for (const std::uint32_t i : played.indices) {
            const std::uint32_t entry = arrays.triangles.at(corner++);
            const glm::dvec3 p = placement * glm::dvec4(positions[entry], 1.0);
            off.distance = std::max(off.distance, glm::distance(played.positions[i], p));
            if (played.normals.empty() || normals.empty() || glm::length(normals[entry]) < 0.5f) continue;
            const glm::dvec3 n = glm::dmat3(placement) * glm::dvec3(normals[entry]);
            off.angle = std::max(off.angle, std::atan2(glm::length(glm::cross(n, played.normals[i])),
                                                       glm::dot(n, played.normals[i])));
        }
    }
    CHECK(corner == arrays.triangles.size());
    return off;
}

/// Checks that the file is as near to all frames as the report says, and no nearer than a bit: what the
/// placement's floats are rounded by.
inline void check_follows(const std::filesystem::path& file, const mesh::Mesh& mesh, clip::Frames& frames,
                          const clip::GltfReport& report) {
    const Player player(bytes_of(file));
    Off most;
    double slack = 1e-6 * report.size;
    for (std::size_t f = 0; f < frames.count(); ++f) {
        slack = std::max(
            slack, 1e-6 * report.size + 2e-7 * static_cast<double>(glm::length(frames.placement(f)[3])));
        const Off off = off_at(player, mesh, frames, f);
        most.distance = std::max(most.distance, off.distance);
        most.angle = std::max(most.angle, off.angle);
    }
    CAPTURE(report.size);
    CHECK(most.distance <= report.max_error + slack);
    CHECK(most.distance >= report.max_error - slack);
    CHECK(most.angle <= report.max_angle + 1e-5);
    CHECK(most.angle >= report.max_angle - 1e-5);
}

}  // namespace goffer::test
