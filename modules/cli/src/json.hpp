// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace goffer::cli {

/// Parses the text of `file`. Throws InputError, of one line that names the file, where it is not JSON, is
/// nested more than 32 deep, or an object has a name twice: JSON itself would let the last one count.
[[nodiscard]] nlohmann::json parse_json(const std::filesystem::path& file, const std::string& text);

/// What an error of the library says, without its own "[json.exception..] ".
[[nodiscard]] std::string reason(const nlohmann::json::exception& error);

}  // namespace goffer::cli
