// SPDX-License-Identifier: MIT
#include "crossing.hpp"

#include <goffer/bend/capsules.hpp>
#include <goffer/bend/job.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace goffer::cli {
namespace {

constexpr std::size_t most_capsules = 1024;

/// Pieces of each region, so short that no two parts pass between their middles.
std::size_t pieces_of(const bend::Body& body) {
    const double regions = static_cast<double>(body.region_count());
    const double wanted = std::ceil(2 * body.length() / (regions * body.radius()));
    return static_cast<std::size_t>(std::clamp(wanted, 4.0, std::max(most_capsules / regions, 4.0)));
}

bool crosses(const bend::Body& body, std::span<const bend::Pose> poses) {
    constexpr float deep = 0.6f, far_along = 2;  // of the sum of both radii
    const std::size_t pieces = pieces_of(body);
    std::vector<bend::Capsule> capsules(bend::capsule_count(body, pieces));
    bend::capsules({.body = &body, .poses = poses}, pieces, capsules);
    struct Part {
        glm::vec3 middle;
        float radius, along;
    };
    std::vector<Part> parts;
    float along = 0;
    for (const bend::Capsule& capsule : capsules) {
        const float length = glm::distance(capsule.from, capsule.to);
        parts.push_back({0.5f * (capsule.from + capsule.to), capsule.radius, along + 0.5f * length});
        along += length;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Part &a = parts[j], &b = parts[i];
            const float both = a.radius + b.radius;
            if (b.along - a.along > far_along * both && glm::distance(a.middle, b.middle) < deep * both)
                return true;
        }
    }
    return false;
}

}  // namespace

bool runs_through_itself(const bend::Body& body, std::span<const bend::Pose> poses) {
    return crosses(body, poses) && !crosses(body, body.rest_poses());
}

}  // namespace goffer::cli
