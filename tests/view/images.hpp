// SPDX-License-Identifier: MIT
#pragma once

#include "support/png.hpp"

#include <goffer/view/texture.hpp>

#include <doctest/doctest.h>
#include <jpeglib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>  // jpeglib.h does without, and needs it
#include <cstdlib>
#include <string>
#include <vector>

/// Images, and their files.

namespace goffer::test {

inline view::Image image_of(int width, int height, const Rgb& rgb) {
    view::Image image{width, height, {}};
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        image.rgba.insert(image.rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
    return image;
}

/// `channels`: 3, or 1 for gray, or 4 for the colors of print.
inline std::string jpeg_of(int width, int height, const Rgb& values, int channels = 3,
                           bool progressive = false) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &memory, &size);
    info.image_width = static_cast<JDIMENSION>(width);
    info.image_height = static_cast<JDIMENSION>(height);
    info.input_components = channels;
    info.in_color_space = channels == 3 ? JCS_RGB : channels == 1 ? JCS_GRAYSCALE : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 95, TRUE);
    if (progressive) jpeg_simple_progression(&info);
    jpeg_start_compress(&info, TRUE);
    Rgb row(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels));
    while (info.next_scanline < info.image_height) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(info.next_scanline * row.size()), row.size(),
                    row.begin());
        unsigned char* first = row.data();
        jpeg_write_scanlines(&info, &first, 1);
    }
    jpeg_finish_compress(&info);
    std::string bytes(reinterpret_cast<char*>(memory), size);
    jpeg_destroy_compress(&info);
    std::free(memory);
    return bytes;
}

}  // namespace goffer::test
