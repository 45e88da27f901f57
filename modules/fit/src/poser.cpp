// SPDX-License-Identifier: MIT
#include "poser.hpp"

#include <goffer/bend/job.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::fit {
namespace {

/// A pose as a vector, which points where it bends and is as long as its angle.
glm::vec2 arc_of(const bend::Pose& pose) {
    return pose.angle * glm::vec2(std::cos(pose.direction), std::sin(pose.direction));
}

bend::Pose bent_by(const bend::Pose& pose, glm::vec2 change) {
    const glm::vec2 arc = arc_of(pose) + change;
    return {glm::length(arc), std::atan2(arc.y, arc.x)};
}

}  // namespace

std::vector<std::uint32_t> triangles_of(const bend::Region& region, std::span<const std::uint32_t> triangles,
                                        std::span<const std::uint32_t> place) {
    std::vector<std::uint32_t> own;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
        int corners = 0;
        for (std::size_t i = t; i < t + 3; ++i) {
            const std::uint32_t vertex = place.empty() ? triangles[i] : place[triangles[i]];
            corners += vertex >= region.first && vertex < region.last ? 1 : 0;
        }
        if (corners < 2) continue;
        for (std::size_t i = t; i < t + 3; ++i)
            own.push_back(place.empty() ? triangles[i] : place[triangles[i]]);
    }
    return own;
}

Poser::Poser(const bend::Body& body, std::span<const std::uint32_t> triangles)
    : body_(body), poses_(body.rest_poses()) {
    const auto [first, last] = std::ranges::minmax(triangles);
    first_ = first, last_ = last + std::size_t{1};
}

void Poser::bend(std::size_t region, const bend::Pose& pose, Surface& surface) {
    const std::span<const bend::RegionInput> inputs = body_.region_inputs();
    const bend::Pose rest = body_.rest_pose(region);
    const auto follow = [&](std::size_t r) {
        const float share = static_cast<float>(inputs[r].length / inputs[region].length);
        poses_[r] = bent_by(body_.rest_pose(r), share * (arc_of(pose) - arc_of(rest)));
        poses_[r].angle = std::min(poses_[r].angle, body_.max_angle(r));
    };
    for (std::size_t r = region; r > 0 && inputs[r - 1].blend != 0; --r) follow(r - 1);
    for (std::size_t r = region; inputs[r].blend != 0; ++r) follow(r + 1);
    poses_[region] = pose;
    deform(0, surface.bare);
    deform(1, surface.wrinkle);
    for (std::size_t i = first_; i < last_; ++i) surface.wrinkle[i] -= surface.bare[i];
}

Surface Poser::rest() {
    Surface surface;
    deform(0, surface.bare);
    surface.wrinkle.resize(surface.bare.size());
    return surface;
}

void Poser::deform(float wrinkle_weight, std::vector<glm::vec3>& positions) {
    positions.resize(body_.vertex_count());
    bend::DeformJob job;
    job.body = &body_;
    job.poses = poses_;
    job.wrinkle_weight = wrinkle_weight;
    job.transform[3] = -glm::vec3(body_.origin());  // so that no digits are lost far from the origin
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    if (last_ - first_ == body_.vertex_count()) {
        bend::run(job);
    } else {
        bend::run_range(job, first_, last_);
    }
}

}  // namespace goffer::fit
