// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/view/texture.hpp>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace goffer::view {

/// What a pixel of the picture covers of a texture: coordinates, and what they change to the next pixels.
struct Footprint {
    glm::vec2 uv{0}, across{0}, up{0};
};

/// The mean color of a texture over a footprint, linear. What is not finite counts as 0.
[[nodiscard]] glm::vec3 texture_color(const Texture& texture, Footprint over);

}  // namespace goffer::view
