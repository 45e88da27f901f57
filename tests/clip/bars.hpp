// SPDX-License-Identifier: MIT
#pragma once

#include "clips.hpp"

#include <goffer/mesh/mesh.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

/// A small mesh for the tests, and ways for it to move.

namespace goffer::test {

/// A square tube along z, 10 long, with two parts, materials, texture coordinates, and normals with indices:
/// each side has its own, so that every vertex has two.
inline mesh::Mesh bar(int rings = 11) {
    mesh::Mesh mesh;
    const glm::vec2 corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    mesh.normals.values = {{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}};
    mesh.uvs.resize(1);
    for (int ring = 0; ring < rings; ++ring) {
        const float z = 10.0f * static_cast<float>(ring) / static_cast<float>(rings - 1);
        for (const glm::vec2& c : corners) {
            mesh.positions.emplace_back(c, z);
            mesh.uvs[0].values.emplace_back(0.5f * c.x, 0.1f * z);
        }
    }
    for (int ring = 0; ring + 1 < rings; ++ring)
        for (std::uint32_t side = 0; side < 4; ++side) {
            const auto at = [&](int r, std::uint32_t s) { return static_cast<std::uint32_t>(4 * r) + s % 4; };
            for (const std::uint32_t v :
                 {at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)}) {
                mesh.corners.push_back(v);
                mesh.normals.corners.push_back(side);
                mesh.uvs[0].corners.push_back(v);
            }
            mesh.faces.push_back(4);
        }
    const auto half = static_cast<std::uint32_t>(4 * ((rings - 1) / 2)),
               all = static_cast<std::uint32_t>(mesh.faces.size());
    mesh.materials = {{"red", {1, 0, 0, 1}}, {"blue", {0, 0, 1, 1}}};
    mesh.parts = {{"low", 0, 0, half}, {"high", 1, half, all - half}};
    return mesh;
}

/// Bends about the x axis, further up and in later frames more; turns normals with it.
inline glm::vec3 bending(std::size_t frame, const glm::vec3& position, bool is_normal,
                         const glm::vec3& value) {
    const float angle = 0.1f * std::sin(0.3f * static_cast<float>(frame)) * position.z;
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(1, 0, 0)));
    return is_normal ? turn * value : turn * glm::vec3(value.x, value.y, 0) + glm::vec3(0, -angle, value.z);
}

/// Walks on and turns about y, more than once around.
inline glm::mat4x3 circling(std::size_t frame) {
    const float t = 0.4f * static_cast<float>(frame);
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), t, glm::normalize(glm::vec3(0.1f, 1, 0)));
    return glm::mat4x3(glm::translate(glm::mat4(1.0f), glm::vec3(3 * t, 1, -t)) * turn);
}

}  // namespace goffer::test
