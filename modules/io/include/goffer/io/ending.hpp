// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace goffer::io {

/// Returns the ending of a file's name with its dot, its letters A to Z in lower case: ".glb" for "A.GLB", ""
/// where there is none. Thread-safe.
[[nodiscard]] std::string ending_of(const std::filesystem::path& file);

}  // namespace goffer::io
