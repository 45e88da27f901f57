// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

/// Images to put on models: decoded from PNG and JPEG, and averaged for when they are seen from afar.

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

/// Decodes a PNG or a JPEG, whichever it is by its content, from whomever it comes. Of more than
/// `most_pixels` nothing is decoded, nor of more than most_image_pixels; until then it takes 4 bytes a pixel,
/// and a JPEG whose parts come in turns (progressive) as much again or more. Thread-safe.
///
/// Throws Error if it is neither, broken, cut off or larger, or a JPEG in the colors of print (CMYK).
[[nodiscard]] Image decode_image(std::string_view bytes, std::uint64_t most_pixels = most_image_pixels);

/// An image and its copies of half the size, a quarter and so on down to one pixel, each the mean by area, in
/// linear light, of what it stands for. Immutable.
class MipMap {
public:
    /// Throws Error if the image is empty or `rgba` is not width x height x 4 bytes. Runs in parallel in the
    /// caller's oneTBB arena.
    explicit MipMap(Image image);

    /// From the image itself down to 1 x 1.
    [[nodiscard]] std::span<const Image> levels() const { return levels_; }
    /// The linear value, 0 to 1, of a byte of red, green or blue.
    [[nodiscard]] float linear(std::uint8_t byte) const { return linear_[byte]; }

private:
    std::vector<Image> levels_;
    std::array<float, 256> linear_;
};

/// How a texture goes on beyond 0..1.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An image on a model: coordinates 0, 0 are its lower left corner, 1, 1 its upper right one.
struct Texture {
    std::shared_ptr<const MipMap> image;  ///< null: none
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;  ///< when enlarged, pixels are squares rather than blended
};

}  // namespace goffer::view
