// SPDX-License-Identifier: MIT
#include <goffer/io/read_file.hpp>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace goffer::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* unreadable = "cannot be read; check its permissions";

}  // namespace

std::uint64_t size_of_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (error == std::errc::permission_denied) throw Error(about(file, unreadable));
    if (!fs::exists(status)) throw Error(about(file, "there is no such file; check the name"));
    if (fs::is_directory(status)) throw Error(about(file, "is a folder; give the name of a file"));
    if (!fs::is_regular_file(status))
        throw Error(about(file, "is not a regular file; copy what it holds into one"));
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) throw Error(about(file, unreadable));
    return size;
}

std::string read_file(const fs::path& file, const std::function<void(double)>& progress) {
    constexpr std::size_t piece = std::size_t{4} << 20;
    std::string bytes(size_of_file(file), '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(about(file, unreadable));
    for (std::size_t done = 0; done < bytes.size();) {
        const std::size_t size = std::min(piece, bytes.size() - done);
        if (!in.read(bytes.data() + done, static_cast<std::streamsize>(size)))
            throw Error(about(file, in.eof() ? "became shorter while it was read; try again" : unreadable));
        done += size;
        if (progress) progress(static_cast<double>(done) / static_cast<double>(bytes.size()));
    }
    return bytes;
}

}  // namespace goffer::io
