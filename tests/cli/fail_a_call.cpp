// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// A library to be loaded before a program (LD_PRELOAD): of its calls that make a part of an output, write to
/// it, flush it, send it to the disk or rename it, the one whose number GOFFER_FAIL_CALL says fails, as on a
/// full disk.

namespace {

bool is_part(std::string_view path) {
    return path.find("/.goffer-") != path.npos;
}

bool is_part(int descriptor) {
    std::array<char, 4096> path{};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t size = readlink(link.c_str(), path.data(), path.size());
    return size > 0 && is_part(std::string_view(path.data(), static_cast<std::size_t>(size)));
}

/// Counts a call to do with a part; true for the one that has to fail.
bool fails() {
    static int calls = 0;
    const char* const wanted = std::getenv("GOFFER_FAIL_CALL");
    if (!wanted || ++calls != std::atoi(wanted)) return false;
    errno = ENOSPC;
    return true;
}

template <class Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

FILE* fdopen(int descriptor, const char* mode) {
    if (is_part(descriptor) && fails()) return nullptr;
    return real<FILE*(int, const char*)>("fdopen")(descriptor, mode);
}

std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, FILE* stream) {
    if (is_part(fileno(stream)) && fails()) return 0;
    return real<std::size_t(const void*, std::size_t, std::size_t, FILE*)>("fwrite")(bytes, size, count,
                                                                                     stream);
}

int fflush(FILE* stream) {
    if (stream && is_part(fileno(stream)) && fails()) return EOF;
    return real<int(FILE*)>("fflush")(stream);
}

int fsync(int descriptor) {
    if (is_part(descriptor) && fails()) return -1;
    return real<int(int)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
    if (is_part(std::string_view(from)) && fails()) return -1;
    return real<int(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
