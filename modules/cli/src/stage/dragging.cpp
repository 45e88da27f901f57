// SPDX-License-Identifier: MIT
#include "stage/dragging.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace goffer::cli {
namespace {

constexpr glm::vec3 end_color{0.95f, 0.35f, 0.02f}, chosen_color{0.9f, 0.05f, 0.02f};

/// The pose that brings the end of a region, which begins in `frame`, to `target`: an arc's chord leaves its
/// beginning at half its angle.
bend::Pose pose_toward(const glm::mat4x3& frame, const glm::vec3& target) {
    const glm::vec3 away = glm::transpose(glm::mat3(frame[0], frame[1], frame[2])) * (target - frame[3]);
    const float across = std::hypot(away.x, away.y);
    if (!(across > 0)) return {};
    return {2 * std::atan2(across, away.z), std::atan2(away.y, away.x)};
}

}  // namespace

std::optional<std::size_t> end_at(std::span<const glm::mat4x3> frames, const draw::OrbitCamera& camera,
                                  const Pointer& pointer, float reach) {
    for (std::size_t i = frames.size(); i-- > 1;) {
        if (glm::dot(frames[i][3] - camera.eye(), camera.forward()) <= 0) continue;  // behind the eye
        const glm::vec2 away = camera.place(frames[i][3], pointer.aspect) - pointer.place;
        if (glm::length(away * glm::vec2(pointer.aspect, 1)) < reach) return i - 1;
    }
    return std::nullopt;
}

bend::Pose dragged_pose(std::span<const glm::mat4x3> frames, std::size_t region,
                        const draw::OrbitCamera& camera, const Pointer& pointer) {
    const draw::Ray ray = camera.ray(pointer.place, pointer.aspect);
    const glm::vec3 forward = camera.forward();
    const float depth = glm::dot(frames[region + 1][3] - ray.origin, forward);
    return pose_toward(frames[region],
                       ray.origin + ray.direction * (depth / glm::dot(ray.direction, forward)));
}

std::vector<draw::Mark> end_marks(std::span<const glm::mat4x3> frames, std::size_t chosen) {
    std::vector<draw::Mark> ends;
    for (std::size_t i = 1; i < frames.size(); ++i)
        ends.push_back({frames[i][3], i - 1 == chosen && frames.size() > 2 ? chosen_color : end_color});
    return ends;
}

}  // namespace goffer::cli
