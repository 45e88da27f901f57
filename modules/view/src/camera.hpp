// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <glm/vec2.hpp>

namespace goffer::view {

/// A camera in its place. The axes are orthonormal; `tangent` is that of half the field of view, per axis.
struct View {
    glm::vec3 eye, right, up, forward;
    glm::vec2 tangent;
    glm::vec2 pixel{0};  ///< its size, where the picture is 2 wide and 2 high

    /// Returns the ray through a place of the picture, in -1..1 to the right and upward.
    [[nodiscard]] Ray ray(const glm::vec2& place) const;
};

/// Puts the camera in the nearest place from which all `points` are seen with a margin. `aspect` is the
/// picture's width over its height. Throws Error if the camera has no direction, no up or no field of view.
[[nodiscard]] View frame(const Camera& camera, std::span<const glm::vec3> points, float aspect);

/// The points among `points` that frame() puts the camera by, and those that are farthest along an axis of
/// the world. Throws likewise.
[[nodiscard]] std::vector<glm::vec3> deciding_points(const Camera& camera, std::span<const glm::vec3> points,
                                                     float aspect);

}  // namespace goffer::view
