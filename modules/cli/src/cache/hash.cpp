// SPDX-License-Identifier: MIT
#include "cache/hash.hpp"

#include <goffer/io/read_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <vector>

namespace goffer::cli {

InputFile::InputFile(std::filesystem::path file) : file_(std::move(file)), size_(io::size_of_file(file_)) {
    descriptor_ = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
        throw io::Error(io::about(file_, "cannot be read: " + std::generic_category().message(errno)));
}

InputFile::~InputFile() {
    close(descriptor_);
}

void InputFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t got = pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw io::Error(io::about(file_, "cannot be read: " + std::generic_category().message(errno)));
        if (got == 0)
            throw io::Error(io::about(
                file_, "ends at byte " + std::to_string(offset) + ", before it should; copy it again"));
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::uint64_t>(got);
    }
}

void read_pieces(const InputFile& file, std::uint64_t offset,
                 const std::function<void(std::span<const std::byte>)>& take) {
    constexpr std::uint64_t piece = std::uint64_t{1} << 20;
    std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(piece, file.size())));
    while (offset < file.size()) {
        const std::uint64_t count = std::min(piece, file.size() - offset);
        const std::span<std::byte> bytes = std::span(buffer).first(static_cast<std::size_t>(count));
        file.read(offset, bytes);
        take(bytes);
        offset += count;
    }
}

std::uint64_t hash_of_file(const std::filesystem::path& file) {
    bend::Checksum checksum;
    read_pieces(InputFile(file), 0, [&](std::span<const std::byte> bytes) { checksum.add(bytes); });
    return checksum.value();
}

std::uint64_t hash_of(std::span<const std::byte> bytes) {
    bend::Checksum checksum;
    checksum.add(bytes);
    return checksum.value();
}

std::uint64_t hash_of(std::string_view text) {
    return hash_of(std::as_bytes(std::span(text)));
}

}  // namespace goffer::cli
