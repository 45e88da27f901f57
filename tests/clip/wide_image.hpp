// SPDX-License-Identifier: MIT
#pragma once

#include "support/files.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>
#include <png.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Images of 16 bits a channel, as a program gets them that asks libpng for what is in the file.

namespace goffer::test {

struct WideImage {
    std::size_t width = 0, height = 0;
    std::vector<std::uint16_t> rgb;  ///< rows from top to bottom

    [[nodiscard]] glm::dvec3 texel(std::size_t x, std::size_t y) const {
        const std::uint16_t* at = &rgb[3 * (y * width + x)];
        return {at[0], at[1], at[2]};
    }
};

inline WideImage read_wide_image(const std::filesystem::path& file) {
    const std::string bytes = bytes_of(file);
    std::pair<const char*, const char*> rest{bytes.data(), bytes.data() + bytes.size()};
    const auto fail = [](png_structp, const char* text) { throw std::runtime_error(text); };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &rest, [](png_structp from, png_bytep out, std::size_t count) {
        auto& [at, end] = *static_cast<std::pair<const char*, const char*>*>(png_get_io_ptr(from));
        if (static_cast<std::size_t>(end - at) < count) throw std::runtime_error("cut off");
        std::memcpy(out, at, count);
        at += count;
    });
    png_read_info(png, info);
    REQUIRE(png_get_bit_depth(png, info) == 16);
    REQUIRE(png_get_color_type(png, info) == PNG_COLOR_TYPE_RGB);
    for (const png_uint_32 chunk : {PNG_INFO_gAMA, PNG_INFO_sRGB, PNG_INFO_iCCP, PNG_INFO_cHRM})
        CHECK(png_get_valid(png, info, chunk) == 0);
    WideImage image{png_get_image_width(png, info), png_get_image_height(png, info), {}};
    std::vector<png_byte> row(6 * image.width);
    image.rgb.reserve(3 * image.width * image.height);
    for (std::size_t y = 0; y < image.height; ++y) {
        png_read_row(png, row.data(), nullptr);
        for (std::size_t i = 0; i < row.size(); i += 2)
            image.rgb.push_back(static_cast<std::uint16_t>(256 * row[i] + row[i + 1]));
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return image;
}

}  // namespace goffer::test
