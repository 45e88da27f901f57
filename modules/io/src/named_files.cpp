// SPDX-License-Identifier: MIT
#include <goffer/io/named_files.hpp>

#include <algorithm>
#include <system_error>

namespace goffer::io {
namespace {

namespace fs = std::filesystem;

/// Whether `file` lies below `folder`, both without links and dots.
bool is_below(const fs::path& file, const fs::path& folder) {
    const auto end = std::ranges::find(folder, fs::path());  // where the folder is not there, a slash stays
    return std::mismatch(folder.begin(), end, file.begin(), file.end()).first == end;
}

}  // namespace

std::optional<fs::path> NamedFiles::find(const fs::path& name) const {
    // The system would take the name to end at a zero, so that another file than the one looked at is opened.
    if (name.native().find(fs::path::value_type{}) != fs::path::string_type::npos) return std::nullopt;
    const fs::path file = folder_ / name;
    if (allow_outside_) return file;
    std::error_code no_folder, no_file;
    const fs::path folder = fs::weakly_canonical(fs::absolute(folder_ / ".", no_folder), no_folder),
                   place = fs::weakly_canonical(fs::absolute(file, no_file), no_file);
    if (no_folder || no_file || !is_below(place, folder)) return std::nullopt;
    return file;
}

}  // namespace goffer::io
