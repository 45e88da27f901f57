// SPDX-License-Identifier: MIT
#include "figures/folder.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <ranges>
#include <string>
#include <system_error>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

bool is_page(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(2048, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    return text.find(page_mark) != std::string::npos;
}

/// Whether it has anything but what a killed process has left (io::AtomicFile).
bool has_files(const fs::path& folder) {
    return std::ranges::any_of(fs::directory_iterator(folder), [](const fs::directory_entry& entry) {
        return !entry.path().filename().string().starts_with(".goffer-");
    });
}

std::vector<fs::path> missing_folders(fs::path folder) {
    std::vector<fs::path> missing;
    for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) missing.push_back(folder);
    return missing;
}

}  // namespace

PageFolder::PageFolder(fs::path folder) : path_(std::move(folder)) {
    try {
        if (!path_.has_filename()) path_ = path_.parent_path();  // "figures/"
        if (fs::exists(path_) && !fs::is_directory(path_))
            throw InputError(io::about(path_, "is no folder; give another name to -o"));
        made_ = missing_folders(path_);
        fs::create_directories(path_);
        if (has_files(path_) && !is_page(path_ / "index.html"))
            throw InputError(
                io::about(path_, "has files, and no page of goffer figures; give a new folder to -o"));
    } catch (const fs::filesystem_error& error) {
        throw InputError(io::about(path_, "cannot be made or read: " + error.code().message()));
    }
}

PageFolder::~PageFolder() {
    std::error_code ignored;
    for (const fs::path& folder : made_) fs::remove(folder, ignored);  // where it is empty
}

}  // namespace goffer::cli
