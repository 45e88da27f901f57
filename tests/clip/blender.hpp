// SPDX-License-Identifier: MIT
#pragma once

#include "clips.hpp"
#include "played.hpp"
#include "support/files.hpp"
#include "support/worst.hpp"

#include <goffer/clip/gltf.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

/// Blender as a witness.

namespace goffer::test {

/// A vertex in the order of Blender, where each primitive has its own of those that its faces use, by their
/// numbers: as the file has it, and as the frame.
struct Shown {
    glm::dvec3 in_file, in_frame;
};

inline std::vector<Shown> in_order_of_blender(const Player& player, const mesh::Mesh& mesh,
                                              clip::Frames& frames, std::size_t frame) {
    const mesh::VertexArrays arrays = mesh::vertex_arrays(mesh);
    std::vector<glm::vec3> positions(arrays.positions.size()), normals(arrays.normals.size());
    frames.read(frame, positions, normals);
    std::vector<Shown> out;
    std::size_t corner = 0;
    for (const PlayedPrimitive& played : player.at(static_cast<double>(frame) / frames.rate())) {
        std::map<std::uint32_t, std::uint32_t> entry;
        for (const std::uint32_t i : played.indices) entry[i] = arrays.triangles.at(corner++);
        for (const auto& [vertex, e] : entry)
            out.push_back({played.positions[vertex],
                           glm::dmat4x3(frames.placement(frame)) * glm::dvec4(positions[e], 1.0)});
    }
    return out;
}

/// Checks that Blender, where it is installed, shows the vertices of `frames` within the report's error, and
/// those of the file but for the rounding of floats.
inline void check_in_blender(const std::filesystem::path& file, const mesh::Mesh& mesh, clip::Frames& frames,
                             const clip::GltfReport& report, const std::vector<std::size_t>& shown) {
    if (std::system("blender --version > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: blender is not installed");
        return;
    }
    const Folder folder;
    std::string command = "blender -b --factory-startup --python-exit-code 1 --python '" GOFFER_SOURCE_DIR
                          "/tests/clip/blender.py' -- '" +
                          file.string() + "' " + std::to_string(static_cast<int>(frames.rate())) + " '" +
                          (folder / "out").string() + "'";
    for (const std::size_t frame : shown) command += " " + std::to_string(frame);
    REQUIRE(std::system((command + " > '" + (folder / "said").string() + "' 2>&1").c_str()) == 0);
    const std::string bytes = bytes_of(folder / "out");
    const Player player(bytes_of(file));
    std::size_t at = 0;
    double most = 0, from_file = 0;
    for (const std::size_t frame : shown)
        for (const auto& [in_file, in_frame] : in_order_of_blender(player, mesh, frames, frame)) {
            glm::vec3 there;
            REQUIRE(at + sizeof(there) <= bytes.size());
            std::memcpy(&there, bytes.data() + at, sizeof(there));
            at += sizeof(there);
            test::take_worst(most, glm::distance(glm::dvec3(there), in_frame));
            from_file = std::max(from_file, glm::distance(glm::dvec3(there), in_file));
        }
    CHECK(at == bytes.size());
    MESSAGE("Blender is off by ", most, ", the file by ", report.max_error, ", of ", report.size);
    CHECK(from_file <= 5e-6 * report.size);
    CHECK(most <= report.max_error + 5e-6 * report.size);
}

}  // namespace goffer::test
