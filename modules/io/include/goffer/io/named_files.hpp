// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

namespace goffer::io {

/// The files that a document names, by paths relative to its folder, and which of them may be read: a
/// document that somebody else made must not decide that a private file goes into the output. A link that
/// is put in the place of a file between the look and the reading is not found out. Immutable; thread-safe.
class NamedFiles {
public:
    NamedFiles(const std::filesystem::path& document, bool allow_outside)
        : folder_(document.parent_path()), allow_outside_(allow_outside) {}

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

    /// Returns the path of what `name` stands for, which need not be there; nothing if it may not be read.
    /// `name` is decoded: it is what would be opened.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& name) const;

    /// What to say of a name that is not found, after the name itself.
    static constexpr const char* outside =
        ", which lies outside the folder of the file that names it; copy it there, or allow it with "
        "--allow-outside (LoadOptions::allow_outside)";

private:
    std::filesystem::path folder_;
    bool allow_outside_;
};

}  // namespace goffer::io
