// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/view/image.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Images on models, averaged for when they are seen from afar.

namespace goffer::view {

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
