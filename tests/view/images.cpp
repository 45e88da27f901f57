// SPDX-License-Identifier: MIT
#include "images.hpp"

#include "support/files.hpp"
#include "support/says.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

/// Images that come from anybody.

using namespace goffer;
using namespace goffer::test;

namespace {

/// A soft gradient, which JPEG keeps nearly as it is.
Rgb gradient(int width, int height) {
    Rgb rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int value : {255 * x / width, 255 * y / height, 128})
                rgb.push_back(static_cast<std::uint8_t>(value));
    return rgb;
}

std::string error_of(const std::string& bytes, std::uint64_t most = view::most_image_pixels) {
    const std::string error = message_of<view::Error>([&] { (void)view::decode_image(bytes, most); });
    CHECK(error.find('\n') == error.npos);
    return error;
}

/// Every prefix that lacks more than `tail` bytes is refused, and of what has one wrong byte nothing worse
/// comes than other pixels.
void check_damage(const std::string& good, std::size_t tail) {
    for (std::size_t size = 0; size + tail < good.size(); ++size) {
        CAPTURE(size);
        CHECK(!error_of(good.substr(0, size)).empty());
    }
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ flip);
            try {
                const view::Image image = view::decode_image(bad, 1u << 20);
                CHECK(image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                               static_cast<std::size_t>(image.height));
            } catch (const view::Error&) {
            }
        }
    }
}

}  // namespace

TEST_CASE("images: a PNG is decoded to the bit, a JPEG nearly, in all its kinds") {
    const Rgb rgb = gradient(37, 21);
    const view::Image wanted = image_of(37, 21, rgb);
    const view::Image png = view::decode_image(png_of(37, 21, rgb));
    CHECK(png.width == 37);
    CHECK(png.height == 21);
    CHECK(png.rgba == wanted.rgba);
    for (const bool progressive : {false, true}) {
        const view::Image jpeg = view::decode_image(jpeg_of(37, 21, rgb, 3, progressive));
        CHECK(jpeg.width == 37);
        CHECK(jpeg.height == 21);
        REQUIRE(jpeg.rgba.size() == wanted.rgba.size());
        int most = 0;
        for (std::size_t i = 0; i < jpeg.rgba.size(); ++i)
            most = std::max(most, std::abs(jpeg.rgba[i] - wanted.rgba[i]));
        CHECK(most < 12);
    }
    const view::Image gray = view::decode_image(jpeg_of(8, 8, Rgb(64, 100), 1));
    for (std::size_t i = 0; i < gray.rgba.size(); ++i)
        CHECK(std::abs(gray.rgba[i] - (i % 4 == 3 ? 255 : 100)) < 3);
}

TEST_CASE("images: what is no image, or too large, or for print, is refused in one line") {
    CHECK(says(error_of(""), "neither PNG nor JPEG"));
    CHECK(says(error_of("GIF89a"), "neither PNG nor JPEG"));
    const Rgb rgb = gradient(20, 10);
    for (const std::string& bytes : {png_of(20, 10, rgb), jpeg_of(20, 10, rgb)}) {
        CHECK(error_of(bytes, 200).empty());
        CHECK(says(error_of(bytes, 199),
                   "the image is 20 x 10 pixels; make it no more than 16384 a side, and 199"));
    }
    const int wide = static_cast<int>(view::largest_image_side) + 1;
    const Rgb line(static_cast<std::size_t>(wide) * 3, 7);
    CHECK(says(error_of(png_of(wide, 1, line)), "no more than 16384 a side"));
    CHECK(says(error_of(jpeg_of(wide, 1, line)), "no more than 16384 a side"));
    CHECK(says(error_of(jpeg_of(8, 8, Rgb(256, 100), 4)), "the JPEG is broken or of a rare kind"));
}

TEST_CASE("images: a JPEG of very many scans is refused before it costs time") {
    const std::string good = jpeg_of(16, 16, gradient(16, 16), 3, true);
    CHECK(error_of(good).empty());
    // Its last scan, from the last marker of one on, over and over.
    const std::size_t last = good.rfind("\xff\xda");
    REQUIRE(last != good.npos);
    const std::string scan = good.substr(last, good.size() - 2 - last);
    std::string many = good.substr(0, good.size() - 2);
    for (int i = 0; i < 200; ++i) many += scan;
    CHECK(says(error_of(many + "\xff\xd9"), "scans"));
}

TEST_CASE("images: damaged PNGs") {
    constexpr std::size_t tail = 4 + 12;  // the last checksum, and IEND: what is before has all pixels
    check_damage(png_of(9, 7, gradient(9, 7)), tail);
}

TEST_CASE("images: damaged JPEGs") {
    check_damage(jpeg_of(17, 9, gradient(17, 9)), 0);
    check_damage(jpeg_of(17, 9, gradient(17, 9), 3, true), 0);
}

TEST_CASE("images: copies of half the size have the mean by area, in linear light") {
    // White, black and white have two thirds of the light, which is 213 in sRGB.
    const view::MipMap three(image_of(3, 1, {255, 255, 255, 0, 0, 0, 255, 255, 255}));
    REQUIRE(three.levels().size() == 2);
    CHECK(three.levels()[1].width == 1);
    CHECK(three.levels()[1].rgba == std::vector<std::uint8_t>{213, 213, 213, 255});
    // 5 to 2: the middle one is shared.
    const view::MipMap five(image_of(5, 1, {255, 0, 0, 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0}));
    REQUIRE(five.levels().size() == 3);
    CHECK(five.levels()[1].rgba[0] == 255);
    CHECK(five.levels()[1].rgba[4] == 124);  // a fifth of the light
    CHECK(five.levels()[2].rgba[0] == 204);  // three fifths, of rounded halves
    CHECK_THROWS_AS(view::MipMap(view::Image{}), view::Error);
    CHECK_THROWS_AS(view::MipMap(view::Image{2, 2, std::vector<std::uint8_t>(15)}), view::Error);
}

// A pixel of 16 bits a color, half as large as can be; and one of 8 with a gAMA of 1. Both are sRGB, as glTF
// has it.
TEST_CASE("images: the numbers of a PNG are sRGB, whatever it says of its colors") {
    constexpr char wide[] =
        "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x01"
        "\x00\x00\x00\x01\x10\x02\x00\x00\x00\xc0\xe7\x8f\x9d\x00\x00\x00\x0b\x49\x44\x41"
        "\x54\x78\xda\x63\x68\x00\x03\x00\x0a\x87\x03\x01\x57\x62\x68\x81\x00\x00\x00\x00"
        "\x49\x45\x4e\x44\xae\x42\x60\x82";
    constexpr char told[] =
        "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x01"
        "\x00\x00\x00\x01\x08\x02\x00\x00\x00\x90\x77\x53\xde\x00\x00\x00\x04\x67\x41\x4d"
        "\x41\x00\x01\x86\xa0\x31\xe8\x96\x5f\x00\x00\x00\x0c\x49\x44\x41\x54\x78\xda\x63"
        "\x68\x68\x68\x00\x00\x03\x04\x01\x81\x75\x2e\x01\xbc\x00\x00\x00\x00\x49\x45\x4e"
        "\x44\xae\x42\x60\x82";
    for (const std::string_view png :
         {std::string_view(wide, sizeof wide - 1), std::string_view(told, sizeof told - 1)}) {
        const view::Image image = view::decode_image(png);
        REQUIRE(image.rgba.size() == 4);
        for (int c = 0; c < 3; ++c) CHECK(int{image.rgba[static_cast<std::size_t>(c)]} == 0x80);
    }
}
