// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <filesystem>

/// The list of unfinished files that a signal handler goes through. Nothing here allocates: a file that
/// cannot be noted would stay where memory is short.

namespace goffer::io {

/// Held from before a file is made until it is noted: remove_unfinished() waits for that. Holds back the
/// signals of this thread, so that no handler has to wait for the thread that it interrupts.
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
#ifndef _WIN32
    sigset_t held_back_before_;
#endif
};

/// Adds a file to the list. Returns its place there; -1 where the list is full or the path too long for it.
[[nodiscard]] int note_unfinished(const std::filesystem::path& file) noexcept;

/// Takes it off the list; -1 is none.
void forget_unfinished(int place) noexcept;

}  // namespace goffer::io
