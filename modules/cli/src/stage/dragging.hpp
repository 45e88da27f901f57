// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/pose.hpp>
#include <goffer/draw/orbit_camera.hpp>
#include <goffer/draw/renderer.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Regions that are bent by dragging their ends. `frames` are those of Frames::regions().

namespace goffer::cli {

/// How a pointer sees the picture: OrbitCamera has the meaning of `place` and `aspect`.
struct Pointer {
    glm::vec2 place;
    float aspect = 1;
};

/// The region whose end is no farther from the pointer than `reach`, in halves of the picture's height.
[[nodiscard]] std::optional<std::size_t> end_at(std::span<const glm::mat4x3> frames,
                                                const draw::OrbitCamera& camera, const Pointer& pointer,
                                                float reach);

/// The pose that brings the end of `region` to the pointer, in the plane through it that faces the eye, or as
/// near as an arc of its length comes.
[[nodiscard]] bend::Pose dragged_pose(std::span<const glm::mat4x3> frames, std::size_t region,
                                      const draw::OrbitCamera& camera, const Pointer& pointer);

/// The ends of all regions, that of the `chosen` one in another color where there are several.
[[nodiscard]] std::vector<draw::Mark> end_marks(std::span<const glm::mat4x3> frames, std::size_t chosen);

}  // namespace goffer::cli
