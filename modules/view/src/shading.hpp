// SPDX-License-Identifier: MIT
#pragma once

#include "camera.hpp"
#include "sampler.hpp"

namespace goffer::view {

/// Returns the linear color, 0..1, of what the picture shows at `place` (-1..1 to the right and upward).
/// `hits` is scratch memory.
[[nodiscard]] glm::vec3 shade(const Scene& scene, const View& view, const glm::vec2& place, Sampler& sampler,
                              std::vector<Hit>& hits);

}  // namespace goffer::view
