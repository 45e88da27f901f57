// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace goffer::fit {

/// Returns a number for each vertex that tells its place, from 0 on; vertices at one place share it.
[[nodiscard]] std::vector<std::uint32_t> places(std::span<const glm::vec3> positions);

}  // namespace goffer::fit
