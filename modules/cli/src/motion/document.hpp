// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

/// The files that motions and paths are read from.

namespace goffer::cli {

/// The document in a file of keys: JSON, or a table of comma-separated values that says the same. Throws
/// InputError, or io::Error, in one line that names the file.
[[nodiscard]] nlohmann::json read_keys_file(const std::filesystem::path& file);

/// The document in a file of a path: JSON, or a text of three numbers a line.
[[nodiscard]] nlohmann::json read_path_file(const std::filesystem::path& file);

}  // namespace goffer::cli
