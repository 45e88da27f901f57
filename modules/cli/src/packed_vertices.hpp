// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace goffer::cli {

/// Decodes packed vertices that begin at `first`, `stride` bytes apart, with the text that shaders have.
/// `low` and `high` are the instance's bounds; `normals` has as many entries as `positions`.
void unpack_vertices(const std::byte* first, std::size_t stride, const glm::vec3& low, const glm::vec3& high,
                     std::span<glm::vec3> positions, std::span<glm::vec3> normals);

}  // namespace goffer::cli
