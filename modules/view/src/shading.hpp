// SPDX-License-Identifier: MIT
#pragma once

#include "camera.hpp"
#include "sampler.hpp"

#include <cstdint>
#include <span>

/// Colors are linear, 0..1 once they are exposed.

namespace goffer::view {

/// What reaches a surface: the share of the key light, and of the sky.
struct Light {
    float key = 1, sky = 1;
};

/// Light as `rays` rays of each kind find it.
[[nodiscard]] Light light_at(const Scene& scene, const View& view, const Surface& surface,
                             const glm::vec3& to_eye, Sampler& sampler, std::uint32_t rays);

/// The color of a surface in that light.
[[nodiscard]] glm::vec3 shade(const View& view, const Surface& surface, const glm::vec3& to_eye,
                              const Light& light);

/// What is seen at `place` (-1..1 to the right and upward) where there is nothing.
[[nodiscard]] glm::vec3 background(const glm::vec2& place);

/// `color`, which lies at the end of `ray`, seen through the ghosts that Scene::ghosts() found along it.
[[nodiscard]] glm::vec3 under_ghosts(const Scene& scene, const View& view, const Ray& ray,
                                     std::span<const Hit> ghosts, glm::vec3 color);

}  // namespace goffer::view
