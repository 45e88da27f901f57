// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/io/error.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace goffer::io {

/// Returns all bytes of a regular file; a pipe or a device might never end. Throws Error if it is missing,
/// something else, or unreadable. `progress` is called with the share that is read, 0 to 1, ascending, for
/// each few megabytes, from the calling thread; it must not throw. Empty: nobody is told. Thread-safe.
[[nodiscard]] std::string read_file(const std::filesystem::path& file,
                                    const std::function<void(double)>& progress = {});

/// Returns the size of a regular file. Throws Error likewise. Thread-safe.
[[nodiscard]] std::uint64_t size_of_file(const std::filesystem::path& file);

}  // namespace goffer::io
