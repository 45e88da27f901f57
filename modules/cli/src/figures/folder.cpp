// SPDX-License-Identifier: MIT
#include "figures/folder.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <ranges>
#include <regex>
#include <string>
#include <system_error>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

/// The text of a page of goffer figures; nothing where it is none.
std::string page_in(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    return text.find(page_mark) == std::string::npos ? std::string() : text;
}

/// What it shows and links, by the names that figures have.
std::vector<std::string> files_of(const std::string& page) {
    const std::regex link(R"re((?:src|href)="([a-z0-9_.]+\.(?:csv|gp|png|svg))")re");
    std::vector<std::string> files;
    for (std::sregex_iterator found(page.begin(), page.end(), link), end; found != end; ++found)
        files.push_back((*found)[1]);
    return files;
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
        const std::string page = page_in(path_ / "index.html");
        earlier_ = files_of(page);
        if (has_files(path_) && page.empty())
            throw InputError(
                io::about(path_, "has files, and no page of goffer figures; give a new folder to -o"));
    } catch (const fs::filesystem_error& error) {
        remove_made();
        throw InputError(io::about(path_, "cannot be made or read: " + error.code().message()));
    }
}

PageFolder::~PageFolder() {
    remove_made();
}

void PageFolder::remove_made() noexcept {
    std::error_code ignored;
    for (const fs::path& folder : made_) fs::remove(folder, ignored);  // where it is empty
}

void PageFolder::keep(const std::vector<std::string>& files) {
    made_.clear();
    std::error_code ignored;
    for (const std::string& file : earlier_)
        if (std::ranges::find(files, file) == files.end()) fs::remove(path_ / file, ignored);
}

}  // namespace goffer::cli
