// SPDX-License-Identifier: MIT
#pragma once

#include "camera.hpp"
#include "sampler.hpp"

namespace goffer::view {

/// Linear color of what `place` of the picture shows (-1..1 to the right and upward), 0..1. `hits` is
/// scratch.
[[nodiscard]] glm::vec3 shade(const Scene& scene, const View& view, const glm::vec2& place, Sampler& sampler,
                              std::vector<Hit>& hits);

}  // namespace goffer::view
