// SPDX-License-Identifier: MIT
#include "figures/folder.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace goffer::cli {
namespace {

namespace fs = std::filesystem;

/// The text of a page of goffer figures; nothing where it is none.
std::string page_in(const fs::path& file) {
    constexpr std::uint64_t most = std::uint64_t{8} << 20;
    if (!fs::is_regular_file(file) || fs::file_size(file) > most) return {};
    std::string text = io::read_file(file);
    return text.find(page_mark) == std::string::npos ? std::string() : text;
}

/// Whether a figure has such a name.
bool is_name_of_figure(std::string_view name) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789_.";
    constexpr std::array<std::string_view, 4> endings{".csv", ".gp", ".png", ".svg"};
    return !name.starts_with('.') && name.find_first_not_of(letters) == name.npos &&
           std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

/// What it shows and links, by the names that figures have.
std::vector<std::string> files_of(std::string_view page) {
    std::vector<std::string> files;
    for (const std::string_view attribute : {"src=\"", "href=\""}) {
        for (std::size_t at = 0; (at = page.find(attribute, at)) != page.npos;) {
            at += attribute.size();
            const std::string_view name = page.substr(at, page.find('"', at) - at);
            if (is_name_of_figure(name)) files.emplace_back(name);
        }
    }
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
            throw InputError(io::about(path_, "is not a folder; give another name to -o"));
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
