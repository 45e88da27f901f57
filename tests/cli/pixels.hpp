// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <png.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace goffer::test {

/// A picture that the command has written, as 8-bit RGB or another of libpng's formats.
struct Pixels {
    std::size_t width = 0, height = 0;
    std::vector<png_byte> bytes;

    explicit Pixels(const std::filesystem::path& file, png_uint_32 format = PNG_FORMAT_RGB) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_file(&image, file.string().c_str()) != 0);
        image.format = format;
        width = image.width;
        height = image.height;
        bytes.resize(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) != 0);
    }

    /// Red, green and blue, 0..255, of RGB.
    [[nodiscard]] std::array<int, 3> at(std::size_t x, std::size_t y) const {
        const png_byte* const pixel = &bytes[3 * (y * width + x)];
        return {pixel[0], pixel[1], pixel[2]};
    }
};

}  // namespace goffer::test
