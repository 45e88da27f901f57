// SPDX-License-Identifier: MIT
#include "placed.hpp"

#include <goffer/io/error.hpp>

#include <glm/vec4.hpp>

#include <cmath>

namespace goffer::clip {

void place(const glm::mat4x3& placement, std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
    const glm::dmat4x3 exact(placement);
    for (glm::vec3& p : positions) p = glm::vec3(exact * glm::dvec4(p, 1.0));
    for (glm::vec3& n : normals) n = glm::vec3(exact * glm::dvec4(n, 0.0));
}

void check_finite(std::span<const glm::vec3> values, const char* what, std::size_t frame,
                  const std::filesystem::path& file, const std::string& mend) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::vec3& v = values[i];
        if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) continue;
        fail(file, "frame " + std::to_string(frame) + ", " + what + " " + std::to_string(i) +
                       " (counted from 0) is not finite; " + mend);
    }
}

void fail(const std::filesystem::path& file, const std::string& what) {
    throw io::Error(io::about(file, what));
}

}  // namespace goffer::clip
