// SPDX-License-Identifier: MIT
#include "part_file.hpp"

#include <goffer/io/atomic_file.hpp>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace goffer::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw Error(about(file, what));
}

fs::path folder_of(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

void refuse_unwritable(const fs::path& target) {
    std::error_code error;
    const fs::path folder = folder_of(target);
    if (target.filename().empty() || fs::is_directory(target, error))
        fail(target, "is a folder; give the name of a file");
    if (!fs::is_directory(folder, error)) fail(target, "there is no such folder to write to; make it first");
    if (fs::is_symlink(target, error)) fail(target, "is a link that leads to itself; give another name");
    const bool exists = fs::exists(target, error);
    if (error == std::errc::filename_too_long)
        fail(target, "cannot be written: its name is too long; give a shorter one");
    if (!exists) return;
    if (!fs::is_regular_file(target, error)) fail(target, "is not a regular file; give the name of one");
    // Moving a file over another needs no right to write to that one; a write-protected output stays
    // protected.
    std::FILE* existing = std::fopen(target.string().c_str(), "r+b");
    if (!existing) fail(target, "is write-protected; give another name or change its permissions");
    std::fclose(existing);
    if (!may_replace(folder, target))
        fail(target, "is another user's, in a folder where only owners replace files; give another name");
}

}  // namespace

fs::path link_target(fs::path file) {
    std::error_code error;
    constexpr int max_links = 40;  // as many as systems follow; what is still a link then is a loop
    for (int i = 0; i < max_links && fs::is_symlink(file, error); ++i)
        file = file.parent_path() / fs::read_symlink(file, error);
    return file;
}

AtomicFile::AtomicFile(fs::path target) : target_(link_target(std::move(target))) {
    refuse_unwritable(target_);
    remove_stale_parts(folder_of(target_));
    PartFile part = open_part(folder_of(target_));
    if (!part.stream) give_up(errno);
    stream_ = part.stream;
    beside_ = std::move(part.path);
    noted_ = part.noted;
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
    if (beside_.empty()) return;
    std::error_code ignored;
    fs::remove(beside_, ignored);
    forget_part(noted_);
}

void AtomicFile::write(std::string_view bytes) {
    flushed_ = false;
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) give_up(errno);
}

void AtomicFile::replace_start(std::string_view bytes) {
    if (std::fflush(stream_) != 0 || std::fseek(stream_, 0, SEEK_SET) != 0) give_up(errno);
    write(bytes);
}

void AtomicFile::flush() {
    if (flushed_) return;
    if (std::ferror(stream_) != 0) give_up(EIO);
    if (!synchronize(stream_)) give_up(errno);
    flushed_ = true;
}

/// Where it can be, the file is closed last, since its lock ends then.
void AtomicFile::commit() {
    flush();
    if (!renames_open_files) std::fclose(std::exchange(stream_, nullptr));
    std::error_code error;
    const fs::file_status old = fs::status(target_, error);
    if (fs::exists(old)) fs::permissions(beside_, old.permissions(), error);
    fs::rename(beside_, target_, error);
    if (error) give_up(error.value());
    beside_.clear();
    forget_part(noted_);
    if (stream_) std::fclose(std::exchange(stream_, nullptr));
    synchronize_folder(folder_of(target_));
}

void AtomicFile::give_up(int error_number) const {
    fail(target_, "cannot be written: " + std::generic_category().message(error_number) +
                      "; check the folder's permissions and the free space, or give another name");
}

AtomicFile& AtomicFiles::add(fs::path target) {
    return *files_.emplace_back(std::make_unique<AtomicFile>(std::move(target)));
}

std::uint64_t AtomicFile::bytes() {
    flush();
    std::error_code error;
    const std::uintmax_t size = fs::file_size(beside_, error);
    if (error) give_up(error.value());
    return size;
}

std::uint64_t AtomicFiles::bytes() {
    std::uint64_t sum = 0;
    for (const auto& file : files_) sum += file->bytes();
    return sum;
}

void AtomicFiles::flush() {
    for (const auto& file : files_) file->flush();
}

void AtomicFiles::commit() {
    flush();
    for (const auto& file : files_) file->commit();
}

void write_file(const fs::path& target, std::string_view bytes) {
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

}  // namespace goffer::io
