// SPDX-License-Identifier: MIT
#include "packed_vertices.hpp"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cstring>

namespace goffer::cli {
namespace {

namespace shader {
using namespace glm;
#include <goffer/bend/packed.glsl>
}  // namespace shader

}  // namespace

void unpack_vertices(const std::byte* first, std::size_t stride, const glm::vec3& low, const glm::vec3& high,
                     std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::uvec3 words;
        std::memcpy(&words, first + i * stride, sizeof words);
        positions[i] = shader::goffer_position(words, low, high);
        normals[i] = shader::goffer_normal(words);
    }
}

}  // namespace goffer::cli
