// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/io/atomic_file.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace goffer::clip {

/// A PNG of 16 bits a channel that is written row by row. It has no chunk about color: the numbers are no
/// colors, and a decoder that is told nothing leaves them alone.
class WidePng {
public:
    /// Begins an image in `out`, which must outlive it; `file` is its name, for errors. The sides are 1 or
    /// more. Throws io::Error.
    WidePng(std::size_t width, std::size_t height, io::AtomicFile& out, const std::filesystem::path& file);
    ~WidePng();

    /// Appends a row: red, green and blue of each texel. Throws io::Error.
    void write_row(std::span<const std::uint16_t> rgb);

    /// Ends the image, of which all rows were written. Throws io::Error.
    void finish();

private:
    struct Encoder;
    void check(bool good);

    std::unique_ptr<Encoder> encoder_;
    io::AtomicFile& out_;
    std::filesystem::path file_;
};

}  // namespace goffer::clip
