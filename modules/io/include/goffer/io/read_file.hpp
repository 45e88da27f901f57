// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/io/error.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace goffer::io {

/// Returns all bytes of a regular file; a pipe or a device might never end. Throws Error if it is missing,
/// something else, or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Returns the size of a regular file. Throws Error likewise.
[[nodiscard]] std::uint64_t size_of_file(const std::filesystem::path& file);

}  // namespace goffer::io
