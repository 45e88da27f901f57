// SPDX-License-Identifier: MIT
// libpng and libjpeg are libraries of the machine; of stb_image the header is enough.
#include "decode.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <algorithm>
#include <memory>
#include <string>

namespace goffer::view {

Image decode_image(std::string_view bytes, std::uint64_t most_pixels) {
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
    Image image;
    int channels = 0;
    const auto broken = [] {
        return Error(std::string("the image is broken, or neither PNG nor JPEG (") + stbi_failure_reason() +
                     "); export it again");
    };
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0) throw broken();
    const auto width = static_cast<std::uint64_t>(image.width),
               height = static_cast<std::uint64_t>(image.height);
    check_image_size(width, height, most_pixels);
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &image.width, &image.height, &channels, 4), stbi_image_free);
    if (!pixels) throw broken();
    image.rgba.assign(pixels.get(), pixels.get() + 4 * width * height);
    return image;
}

}  // namespace goffer::view
