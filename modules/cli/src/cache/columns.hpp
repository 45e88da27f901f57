// SPDX-License-Identifier: MIT
#pragma once

#include "cache/hash.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace goffer::cli {

/// Numbers out of a file that a game or another program wrote, in rows: little-endian floats one after the
/// other, or, where its name ends in .csv, text with commas, semicolons, spaces or ends of lines between the
/// numbers. Text is held in memory; floats are read where they are asked for. Thread-safe.
class NumberFile {
public:
    /// `most`: bytes of memory that the numbers of a text may take. Throws an error that names the file.
    NumberFile(const std::filesystem::path& file, std::uint64_t most);

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_; }
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

    /// Bytes that its numbers take in memory: 0 unless they are text.
    [[nodiscard]] std::uint64_t memory() const noexcept { return text_.capacity() * sizeof(float); }

    /// Numbers [first, first + out.size()), which must be there. Throws an error that names the file and the
    /// number where one is not finite.
    void read(std::uint64_t first, std::span<float> out) const;

private:
    std::filesystem::path file_;
    std::unique_ptr<InputFile> binary_;
    std::vector<float> text_;
    std::uint64_t count_ = 0;
};

}  // namespace goffer::cli
