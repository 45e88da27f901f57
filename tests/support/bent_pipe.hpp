// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/base.hpp>
#include <goffer/paper/chain.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace goffer::test {

/// A closed pipe of radius 1 in the shape of an S: two arcs of 120 degrees, 12 long each, the one back from
/// the other.
struct BentPipe {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;

    BentPipe() {
        constexpr double half = 12, angle = 2 * std::numbers::pi / 3;
        const paper::BaseMesh straight = paper::base_mesh(2 * half, 1, 32, 193, true);
        const std::vector<paper::Parameters> regions(2, {.length = half, .radius = 1});
        const std::vector<paper::Pose> poses{{angle, 0}, {angle, std::numbers::pi}};
        const paper::Chain chain(regions, poses);
        triangles = straight.triangles;
        for (const auto& p : straight.positions) {
            paper::Cylindrical at = paper::to_cylindrical(glm::dvec3(p));
            const std::size_t region = at.z > half ? 1 : 0;
            at.z -= region == 1 ? half : 0;
            positions.emplace_back(chain.position(region, at));
        }
    }
};

}  // namespace goffer::test
