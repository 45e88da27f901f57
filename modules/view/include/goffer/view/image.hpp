// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

/// Images to put on models, decoded from PNG and JPEG.

namespace goffer::view {

/// Thrown for a picture that cannot be made, and an image that cannot be read. what() is one line: what is
/// wrong, where, and how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An image in 8-bit sRGB with alpha: rows from top to bottom, 4 bytes a pixel.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// The most pixels of an image along a side, and the most in all.
inline constexpr std::uint64_t largest_image_side = 16384, most_image_pixels = std::uint64_t{64} << 20;

/// Decodes a PNG or a JPEG, told apart by content; the bytes may be untrusted. Images beyond `most_pixels`,
/// most_image_pixels or largest_image_side are refused before anything is decoded. Takes 4 bytes a pixel, and
/// a progressive JPEG at least twice that. Thread-safe.
///
/// Throws Error if it is neither, broken, cut off or too large, a CMYK JPEG, or one of more than 100 scans.
/// In browsers, what is missing of a JPEG is gray instead, and those of print are shown.
[[nodiscard]] Image decode_image(std::string_view bytes, std::uint64_t most_pixels = most_image_pixels);

/// Returns the light, 0..1, that a value of an sRGB image stands for, 0..1 too.
[[nodiscard]] inline float linear_of(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}
/// Returns the value that stands for that much light: the inverse of linear_of().
[[nodiscard]] inline float encoded_of(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace goffer::view
