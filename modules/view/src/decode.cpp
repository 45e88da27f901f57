// SPDX-License-Identifier: MIT
#include "decode.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <string>

namespace goffer::view {

namespace {

std::uint32_t big_endian(std::string_view four) {
    std::uint32_t value = 0;
    for (const char byte : four) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
}

/// A PNG less what says which colors its numbers stand for: as glTF has it, they are sRGB.
std::string without_color_spaces(std::string_view bytes) {
    constexpr std::array<std::string_view, 5> told{"gAMA", "cHRM", "sRGB", "iCCP", "cICP"};
    constexpr std::size_t signature = 8, frame = 12;  // a chunk's length, its name and its checksum
    std::string out(bytes.substr(0, signature));
    for (std::size_t at = signature; at < bytes.size();) {
        const std::string_view rest = bytes.substr(at);
        const std::size_t length =
            rest.size() < frame ? rest.size()
                                : std::min<std::size_t>(rest.size(), frame + big_endian(rest.substr(0, 4)));
        if (rest.size() < frame || std::ranges::find(told, rest.substr(4, 4)) == told.end())
            out += rest.substr(0, length);
        at += length;
    }
    return out;
}

}  // namespace

Image decode_png(std::string_view file, std::uint64_t most_pixels) {
    const std::string bytes = without_color_spaces(file);
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    // png_image_finish_read() frees all that was taken, and so does png_image_begin_.. where it fails.
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
        header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
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
