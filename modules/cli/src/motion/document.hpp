// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>

/// The files that motions and paths are read from.

namespace goffer::cli {

/// The most bytes that such a file has: read, it takes up to a hundred times as many.
inline constexpr std::uint64_t most_motion_text = std::uint64_t{8} << 20;

/// The document in a file of keys: JSON, or a table of comma-separated values that says the same. Throws
/// InputError, or io::Error, in one line that names the file.
[[nodiscard]] nlohmann::json read_keys_file(const std::filesystem::path& file);

/// The document in a file of a path: JSON, or a text of three numbers a line.
[[nodiscard]] nlohmann::json read_path_file(const std::filesystem::path& file);

}  // namespace goffer::cli
