// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/io/error.hpp>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

/// Files that appear whole or not at all, for every output that goffer writes.

namespace goffer::io {

/// Returns where a file of this name is written: symbolic links are followed, also those to what is not
/// there. Thread-safe.
[[nodiscard]] std::filesystem::path link_target(std::filesystem::path file);

/// A file being written beside its place, as .goffer-PROCESS-NUMBER.part; `commit` moves it there. Without a
/// commit (an error, an early return) nothing is left of it, and a file that was there before is as it was.
/// Several outputs are kept together by AtomicFiles. One object belongs to one thread; several may have the
/// same target, the last commit stays.
///
/// What a process that was killed has left is removed when another file is written to the same folder, where
/// it is sure that nobody writes it: the process is gone, and its lock on the file too. Not on Windows, which
/// has no such lock.
class AtomicFile {
public:
    /// Opens the file beside `target`, so that an output that cannot be written is refused before any work is
    /// done. A symbolic link is followed. Throws Error: no such folder, a folder itself, a device, a link
    /// that leads to itself, too long a name, not permitted.
    explicit AtomicFile(std::filesystem::path target);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends `bytes`. Throws Error (disk full, ..).
    void write(std::string_view bytes);

    /// Overwrites the beginning of the file with `bytes`. Nothing may be written afterward. Throws Error.
    void replace_start(std::string_view bytes);

    /// For libraries that write to a C stream; owned by this object, null after `commit`. To be asked for
    /// again to write after a flush().
    [[nodiscard]] std::FILE* stream() {
        flushed_ = false;
        return stream_;
    }

    /// Waits until the disk has all bytes. Throws Error.
    void flush();

    /// Flushes the file and puts it in its place, with the permissions of the one it replaces; then waits
    /// until the disk has the folder's new entry. To be called once. Throws Error.
    void commit();

    /// Flushes the file, and returns how many bytes it has. Not after commit(). Throws Error.
    [[nodiscard]] std::uint64_t bytes();

private:
    [[noreturn]] void give_up(int error_number) const;

    std::filesystem::path target_;
    std::filesystem::path beside_;
    int noted_ = -1;  // in the list of remove_unfinished()
    std::FILE* stream_ = nullptr;
    bool flushed_ = false;
};

/// Outputs that belong together: none takes its place before all of them are on the disk.
class AtomicFiles {
public:
    /// Opens one more. The reference is good for as long as this object. Throws Error.
    AtomicFile& add(std::filesystem::path target);

    /// Waits until the disk has the bytes of all of them. Throws Error.
    void flush();

    /// Flushes them, and returns how many bytes they have together. To be called before commit(). Throws
    /// Error.
    [[nodiscard]] std::uint64_t bytes();

    /// Flushes them all and puts one after the other in its place. To be called once. Throws Error.
    void commit();

private:
    std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// The whole of a file at once: opened, written and committed. Throws Error.
void write_file(const std::filesystem::path& target, std::string_view bytes);

/// Removes the unfinished files of this process, up to 128 at a time whose absolute paths are shorter than
/// 4096 bytes. None of them can be committed afterward, and files that other threads begin later are refused.
/// For a signal handler that ends the process, and may be called in one; goffer's libraries install none.
/// Does nothing on Windows, where a file that is open cannot be removed.
void remove_unfinished() noexcept;

}  // namespace goffer::io
