// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

/// The list of unfinished files that a handler of signals goes through. Nothing here allocates: a file that
/// cannot be noted would stay where memory is short.

namespace goffer::io {

/// Held from before a file is made until it is noted: remove_unfinished() waits for that.
class Making {
public:
    Making() noexcept;
    ~Making();
    Making(const Making&) = delete;
    Making& operator=(const Making&) = delete;

    /// Whether the process ends, and no file may be made any more.
    [[nodiscard]] bool too_late() const noexcept { return too_late_; }

private:
    bool too_late_ = false;
};

/// Adds a file to the list; without effect where the list is full or the path too long for it.
void note_unfinished(const std::filesystem::path& file) noexcept;

/// Takes it off the list.
void forget_unfinished(const std::filesystem::path& file) noexcept;

}  // namespace goffer::io
