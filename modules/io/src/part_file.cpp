// SPDX-License-Identifier: MIT
#include "part_file.hpp"

#include "unfinished.hpp"

#include <cerrno>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#include <process.h>
#else
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#endif

namespace goffer::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_begin = ".goffer-", name_end = ".part";

#ifdef _WIN32

int process_number() {
    return _getpid();
}

std::FILE* open_new(const fs::path& file) {
    return std::fopen(file.string().c_str(), "wbx");
}

#else

int process_number() {
    return getpid();
}

/// Null with errno. Between the making of the file and its lock somebody may take it for stale and remove it,
/// which reads as EEXIST: another name will do.
std::FILE* open_new(const fs::path& file) {
    constexpr mode_t all_may = 0666;  // but for whom the umask forbids it
    const int descriptor = open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, all_may);
    if (descriptor < 0) return nullptr;
    (void)flock(descriptor, LOCK_EX | LOCK_NB);  // some file systems have none: nothing is removed there
    struct stat status {};
    const bool ours = fstat(descriptor, &status) == 0 && status.st_nlink > 0;
    std::FILE* const stream = ours ? fdopen(descriptor, "wb") : nullptr;
    if (stream) return stream;
    const int reason = ours ? errno : EEXIST;
    if (ours) unlink(file.c_str());
    close(descriptor);
    errno = reason;
    return nullptr;
}

/// The process that a part's name says; 0 if it is no part.
int process_of(std::string_view name) {
    if (!name.starts_with(name_begin) || !name.ends_with(name_end)) return 0;
    name.remove_prefix(name_begin.size());
    name.remove_suffix(name_end.size());
    int process = 0, number = 0;
    const char* end = name.data() + name.size();
    const auto [dash, error] = std::from_chars(name.data(), end, process);
    if (error != std::errc() || dash == end || *dash != '-') return 0;
    const auto [stop, no_number] = std::from_chars(dash + 1, end, number);
    return no_number == std::errc() && stop == end && process > 0 ? process : 0;
}

/// The number alone is not enough: in another container it means another process, which then holds the lock.
/// One of this process's number may be that of an earlier one, as in containers, where it is often 1; what
/// this process writes is locked.
void remove_if_stale(const fs::path& file, int process) {
    const bool runs = kill(process, 0) == 0 || errno != ESRCH;
    if (runs && process != process_number()) return;
    const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;
    struct stat opened {
    }, named{};
    const bool ours = fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) &&
                      opened.st_uid == geteuid() && flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const bool still_there = ours && lstat(file.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
                             named.st_dev == opened.st_dev;
    if (still_there) unlink(file.c_str());
    close(descriptor);
}

#endif

}  // namespace

PartFile open_part(const fs::path& folder) {
    constexpr int tries = 1000;
    std::error_code error;
    const fs::path absolute = fs::absolute(folder, error);  // the working folder may change
    PartFile part;
    const Making making;
    if (making.too_late()) {
        errno = EINTR;
        return part;
    }
    for (int i = 0; i < tries && !part.stream; ++i) {
        part.path =
            (error ? folder : absolute) / (std::string(name_begin) + std::to_string(process_number()) + "-" +
                                           std::to_string(i) + std::string(name_end));
        part.stream = open_new(part.path);
        if (!part.stream && errno != EEXIST) return part;
    }
    if (part.stream) part.noted = note_unfinished(part.path);
    return part;
}

void forget_part(int noted) {
    forget_unfinished(noted);
}

#ifdef _WIN32

void remove_stale_parts(const fs::path&) {}

bool may_replace(const fs::path&, const fs::path&) {
    return true;
}

bool synchronize(std::FILE* stream) {
    return std::fflush(stream) == 0 && _commit(_fileno(stream)) == 0;
}

void synchronize_folder(const fs::path&) {}

#else

void remove_stale_parts(const fs::path& folder) {
    // Not by directory_iterator: where memory is short, libstdc++'s ends the program.
    const auto close = [](DIR* open) { closedir(open); };
    const std::unique_ptr<DIR, decltype(close)> entries(opendir(folder.c_str()), close);
    while (const dirent* const entry = entries ? readdir(entries.get()) : nullptr) {
        const std::string name = entry->d_name;
        if (const int process = process_of(name)) remove_if_stale(folder / name, process);
    }
}

bool may_replace(const fs::path& folder, const fs::path& file) {
    struct stat around {
    }, old{};
    if (stat(folder.c_str(), &around) != 0 || lstat(file.c_str(), &old) != 0) return true;
    const uid_t user = geteuid();
    const bool sticky = (around.st_mode & S_ISVTX) != 0;
    return !sticky || user == 0 || user == around.st_uid || user == old.st_uid;
}

bool synchronize(std::FILE* stream) {
    if (std::fflush(stream) != 0) return false;
    return fsync(fileno(stream)) == 0 || errno == EINVAL || errno == ENOTSUP;  // which have no disk
}

void synchronize_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    (void)fsync(descriptor);
    close(descriptor);
}

#endif

}  // namespace goffer::io
