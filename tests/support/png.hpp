// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace goffer::test {

using Rgb = std::vector<std::uint8_t>;  ///< 3 bytes a pixel, rows from top to bottom

inline std::string png_of(int width, int height, const Rgb& rgb) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    REQUIRE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) != 0);
    bytes.resize(size);
    return bytes;
}

}  // namespace goffer::test
