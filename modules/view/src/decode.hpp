// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/view/image.hpp>

#include <cstdint>
#include <string_view>

namespace goffer::view {

/// What decode_image() does for each format. Throw Error; that does not name the image.
[[nodiscard]] Image decode_png(std::string_view bytes, std::uint64_t most_pixels);
[[nodiscard]] Image decode_jpeg(std::string_view bytes, std::uint64_t most_pixels);

/// Throws Error if the image is larger than images may be.
void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels);

}  // namespace goffer::view
