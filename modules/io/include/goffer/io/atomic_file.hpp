// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/io/error.hpp>

#include <cstdio>
#include <filesystem>
#include <string_view>

/// Files that appear whole or not at all, for every output that goffer writes.

namespace goffer::io {

/// A file being written beside its place, under a name of its own; `commit` moves it there. Without a commit
/// (an error, an early return) nothing is left of it, and a file that was there before is as it was. Several
/// outputs are kept together by writing all of them before committing the first. One object belongs to one
/// thread; several may have the same target, the last commit stays.
class AtomicFile {
public:
    /// Opens the file beside `target`, so that an output that cannot be written is refused before any work is
    /// done. A symbolic link is followed. Throws Error: no such folder, a folder itself, a device, a link
    /// that leads to itself, not permitted.
    explicit AtomicFile(std::filesystem::path target);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends `bytes`. Throws Error (disk full, ..).
    void write(std::string_view bytes);

    /// For libraries that write to a C stream; owned by this object, null after `commit`.
    [[nodiscard]] std::FILE* stream() { return stream_; }

    /// Puts the file in its place, with the permissions of the one it replaces. To be called once. Throws
    /// Error.
    void commit();

private:
    [[noreturn]] void give_up(int error_number) const;

    std::filesystem::path target_;
    std::filesystem::path beside_;
    std::FILE* stream_ = nullptr;
};

/// The whole of a file at once: opened, written and committed. Throws Error.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace goffer::io
