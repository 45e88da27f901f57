// SPDX-License-Identifier: MIT
#pragma once

#include "support/files.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
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

/// libpng's state, with the way out of its errors: C code lies between, which an exception must not cross.
/// Functions that jump, or are jumped over, have no objects with destructors.
class WideDecoder {
public:
    explicit WideDecoder(const std::string& bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, leave, nullptr);
        info = png_create_info_struct(png);
        png_set_read_fn(png, this, take);
    }
    WideDecoder(const WideDecoder&) = delete;
    WideDecoder& operator=(const WideDecoder&) = delete;
    ~WideDecoder() { png_destroy_read_struct(&png, &info, nullptr); }

    /// Return false where they fail, with the message.
    bool read_header() {
        if (setjmp(png_jmpbuf(png)) != 0) return false;
        png_read_info(png, info);
        return true;
    }
    bool read_row(png_bytep row) {
        if (setjmp(png_jmpbuf(png)) != 0) return false;
        png_read_row(png, row, nullptr);
        return true;
    }

    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 128> message{};

private:
    [[noreturn]] static void leave(png_structp from, const char* text) {
        auto& message = static_cast<WideDecoder*>(png_get_error_ptr(from))->message;
        std::snprintf(message.data(), message.size(), "%s", text);
        png_longjmp(from, 1);
    }
    static void take(png_structp from, png_bytep out, std::size_t count) {
        WideDecoder& self = *static_cast<WideDecoder*>(png_get_io_ptr(from));
        if (static_cast<std::size_t>(self.end_ - self.at_) < count) png_error(from, "cut off");
        std::memcpy(out, self.at_, count);
        self.at_ += count;
    }

    const char* at_;
    const char* end_;
};

/// Throws std::runtime_error with libpng's message where the file is no whole PNG.
inline WideImage read_wide_image(const std::filesystem::path& file) {
    const std::string bytes = bytes_of(file);
    WideDecoder decoder(bytes);
    const auto check = [&](bool good) {
        if (!good) throw std::runtime_error(decoder.message.data());
    };
    check(decoder.read_header());
    REQUIRE(png_get_bit_depth(decoder.png, decoder.info) == 16);
    REQUIRE(png_get_color_type(decoder.png, decoder.info) == PNG_COLOR_TYPE_RGB);
    for (const png_uint_32 chunk : {PNG_INFO_gAMA, PNG_INFO_sRGB, PNG_INFO_iCCP, PNG_INFO_cHRM})
        CHECK(png_get_valid(decoder.png, decoder.info, chunk) == 0);
    WideImage image{
        png_get_image_width(decoder.png, decoder.info), png_get_image_height(decoder.png, decoder.info), {}};
    std::vector<png_byte> row(6 * image.width);
    image.rgb.reserve(3 * image.width * image.height);
    for (std::size_t y = 0; y < image.height; ++y) {
        check(decoder.read_row(row.data()));
        for (std::size_t i = 0; i < row.size(); i += 2)
            image.rgb.push_back(static_cast<std::uint16_t>(256 * row[i] + row[i + 1]));
    }
    return image;
}

}  // namespace goffer::test
