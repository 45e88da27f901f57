// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/packed.hpp>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstring>

/// The packed stream as the CPU unpacks it: by the same text that shaders include.

namespace goffer::test {

namespace shader {
using glm::abs;
using glm::max;
using glm::normalize;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
#include <goffer/bend/packed.glsl>
}  // namespace shader

inline glm::uvec3 words(const bend::PackedVertex& vertex) {
    glm::uvec3 result;
    std::memcpy(&result, &vertex, sizeof result);
    return result;
}

}  // namespace goffer::test
