// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/checksum.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

/// Files read in pieces and known by the checksum of their bytes, so that none is in memory as a whole.

namespace goffer::cli {

/// A file open for reading, from any thread at the same time. Throws io::Error where it is missing, no
/// regular file or unreadable.
class InputFile {
public:
    explicit InputFile(std::filesystem::path file);
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_; }
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// Fills `bytes` from `offset` on. Throws io::Error where the file ends before.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Gives all bytes of `file` from `offset` on to `take`, in pieces of 1 MiB, in order.
void read_pieces(const InputFile& file, std::uint64_t offset,
                 const std::function<void(std::span<const std::byte>)>& take);

/// The checksum of a whole file.
[[nodiscard]] std::uint64_t hash_of_file(const std::filesystem::path& file);

/// The checksum of bytes in memory.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes);
[[nodiscard]] std::uint64_t hash_of(std::string_view text);

}  // namespace goffer::cli
