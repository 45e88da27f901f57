// SPDX-License-Identifier: MIT
#include "decode.hpp"

#include <algorithm>
#include <string>

namespace goffer::view {

void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels) {
    const std::uint64_t most = std::min(most_pixels, most_image_pixels);
    if (width < 1 || height < 1) throw Error("the image has no pixels; export it again");
    if (std::max(width, height) > largest_image_side || width * height > most)
        throw Error("the image is " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels; make it no more than " + std::to_string(largest_image_side) + " a side, and " +
                    std::to_string(most) + " in all");
}

}  // namespace goffer::view
