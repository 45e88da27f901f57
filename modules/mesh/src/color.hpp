// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <glm/common.hpp>
#include <glm/gtc/color_space.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace goffer::mesh {

/// A color of `mesh` as a format has it: linear, or encoded as sRGB. Kept as it is if the mesh has it so,
/// else clamped to 0..1.
[[nodiscard]] inline glm::vec4 color_as(bool linear, const Mesh& mesh, const glm::vec4& color) {
    if (linear == mesh.linear_colors) return color;
    const glm::vec3 clamped = glm::clamp(glm::vec3(color), 0.0f, 1.0f);
    return {linear ? glm::convertSRGBToLinear(clamped) : glm::convertLinearToSRGB(clamped), color.a};
}

}  // namespace goffer::mesh
