// SPDX-License-Identifier: MIT
#include "decode.hpp"

#include <png.h>

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

Image decode_png(std::string_view bytes, std::uint64_t most_pixels) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    // Of what it has taken, png_image_finish_read() frees all, and so does png_image_begin_.. where it fails.
    const auto check = [&](int good) {
        if (good == 0) throw Error(std::string("the PNG is broken: ") + header.message + "; export it again");
    };
    check(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()));
    Image image;
    try {
        check_image_size(header.width, header.height, most_pixels);
        image.width = static_cast<int>(header.width);
        image.height = static_cast<int>(header.height);
        header.format = PNG_FORMAT_RGBA;
        image.rgba.resize(PNG_IMAGE_SIZE(header));
    } catch (...) {
        png_image_free(&header);
        throw;
    }
    check(png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr));
    return image;
}

Image decode_image(std::string_view bytes, std::uint64_t most_pixels) {
    if (bytes.starts_with("\x89PNG")) return decode_png(bytes, most_pixels);
    if (bytes.starts_with("\xff\xd8")) return decode_jpeg(bytes, most_pixels);
    throw Error("the image is neither PNG nor JPEG; convert it");
}

}  // namespace goffer::view
