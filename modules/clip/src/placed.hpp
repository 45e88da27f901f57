// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

/// Frames in the space of the scene.

namespace goffer::clip {

/// Carries positions and normals by `placement`, a rotation and a shift, rounding once.
void place(const glm::mat4x3& placement, std::span<glm::vec3> positions, std::span<glm::vec3> normals);

/// Throws io::Error about `file` if one of the `values`, each of which is a `what` of frame `frame`, is not
/// finite; `mend` says what to do then.
void check_finite(std::span<const glm::vec3> values, const char* what, std::size_t frame,
                  const std::filesystem::path& file, const std::string& mend);

/// What there is to do where a clip that is being written is not finite.
inline constexpr const char* use_smaller_numbers = "give the model and its movement smaller numbers";

/// Throws io::Error: "<file>: <what>".
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);

}  // namespace goffer::clip
