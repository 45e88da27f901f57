// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The folder that a page of figures goes to.

namespace goffer::cli {

/// What the pages of `goffer figures` have in them, and no others: their files may be replaced.
inline constexpr std::string_view page_mark = "<meta name=\"generator\" content=\"goffer figures\">";

/// A folder that is there, and can be written to; what was made for it goes again, unless it is kept.
class PageFolder {
public:
    /// Makes the folder, with those above it, where it is missing. Throws InputError or io::Error where it
    /// cannot be made or written to, is no folder, or has files but no page of goffer figures.
    explicit PageFolder(std::filesystem::path folder);
    PageFolder(const PageFolder&) = delete;
    PageFolder& operator=(const PageFolder&) = delete;
    ~PageFolder();

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Leaves the folder as it is, but for files that an earlier page shows and that are none of `files`.
    void keep(const std::vector<std::string>& files);

private:
    void remove_made() noexcept;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_;  // the innermost first
    std::vector<std::string> earlier_;         // files of the page that was there
};

}  // namespace goffer::cli
