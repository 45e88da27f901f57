// SPDX-License-Identifier: MIT
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

fs::path followed(fs::path target) {
    std::error_code error;
    constexpr int max_links = 40;  // as many as systems follow; what is still a link then is a loop
    for (int i = 0; i < max_links && fs::is_symlink(target, error); ++i)
        target = target.parent_path() / fs::read_symlink(target, error);
    return target;
}

void refuse_unwritable(const fs::path& target) {
    std::error_code error;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (target.filename().empty() || fs::is_directory(target, error))
        fail(target, "is a folder; give the name of a file");
    if (!fs::is_directory(folder, error)) fail(target, "there is no such folder to write to; make it first");
    if (fs::is_symlink(target, error)) fail(target, "is a link that leads to itself; give another name");
    if (!fs::exists(target, error)) return;
    if (!fs::is_regular_file(target, error)) fail(target, "is not a regular file; give the name of one");
    // Moving a file over another needs no right to write to that one; a write-protected output stays
    // protected.
    std::FILE* existing = std::fopen(target.string().c_str(), "r+b");
    if (!existing) fail(target, "is write-protected; give another name or change its permissions");
    std::fclose(existing);
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(followed(std::move(target))) {
    refuse_unwritable(target_);
    constexpr int tries = 1000;
    for (int i = 0; i < tries && !stream_; ++i) {
        beside_ = target_;
        beside_ += ".part" + std::to_string(i);
        stream_ = std::fopen(beside_.string().c_str(), "wbx");
        if (!stream_ && errno != EEXIST) give_up(errno);
    }
    if (!stream_) give_up(EEXIST);
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
    std::error_code ignored;
    if (!beside_.empty()) fs::remove(beside_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) give_up(errno);
}

void AtomicFile::commit() {
    const bool failed_before = std::ferror(stream_) != 0;
    const bool failed_now = std::fclose(std::exchange(stream_, nullptr)) != 0;
    if (failed_before || failed_now) give_up(failed_now ? errno : EIO);
    std::error_code error;
    const fs::file_status old = fs::status(target_, error);
    if (fs::exists(old)) fs::permissions(beside_, old.permissions(), error);
    fs::rename(beside_, target_, error);
    if (error) give_up(error.value());
    beside_.clear();
}

void AtomicFile::give_up(int error_number) const {
    fail(target_, "cannot be written: " + std::generic_category().message(error_number) +
                      "; check the folder's permissions and the free space, or give another name");
}

void write_file(const fs::path& target, std::string_view bytes) {
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

}  // namespace goffer::io
