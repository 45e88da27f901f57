// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>

/// What systems do in different ways for files that are being written.

namespace goffer::io {

/// A file that is being written. Until it is forgotten, remove_unfinished() removes it.
struct PartFile {
    std::FILE* stream = nullptr;  ///< null: errno says why
    std::filesystem::path path;
    int noted = -1;  ///< for forget_part
};

/// Makes a new file in `folder`, under a name that no other has. It is locked for as long as it is open,
/// where the system can do that.
[[nodiscard]] PartFile open_part(const std::filesystem::path& folder);

/// To be called with PartFile::noted once a part is renamed or removed.
void forget_part(int noted);

/// Removes the parts in `folder` that a process which is gone has left.
void remove_stale_parts(const std::filesystem::path& folder);

/// Whether this process may move a file over `file` in `folder`, both of which are there: false where the
/// folder is sticky, as /tmp is, and neither is its own.
[[nodiscard]] bool may_replace(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Waits until the disk has what was written. Returns false with errno.
[[nodiscard]] bool synchronize(std::FILE* stream);

/// Waits until the disk has the entries of `folder`, where the system can do that.
void synchronize_folder(const std::filesystem::path& folder);

/// Whether a file that is open can be renamed.
#ifdef _WIN32
inline constexpr bool renames_open_files = false;
#else
inline constexpr bool renames_open_files = true;
#endif

}  // namespace goffer::io
