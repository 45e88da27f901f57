// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

/// The list of unfinished files that a handler of signals goes through. Nothing here allocates: a file that
/// cannot be noted would stay where memory is short.

namespace goffer::io {

/// Adds a file to the list; without effect where the list is full or the path too long for it.
void note_unfinished(const std::filesystem::path& file) noexcept;

/// Takes it off the list.
void forget_unfinished(const std::filesystem::path& file) noexcept;

}  // namespace goffer::io
