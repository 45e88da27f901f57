// SPDX-License-Identifier: MIT
#include <goffer/io/atomic_file.hpp>
#include <goffer/view/picture.hpp>

#include <png.h>

#include <string>

namespace goffer::view {
namespace {

std::string encoded(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;

    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr))
        throw Error(std::string("the picture cannot be packed as PNG: ") + image.message);
    bytes.resize(size);
    return bytes;
}

}  // namespace

void save_png(const Picture& picture, const std::filesystem::path& file) {
    io::AtomicFiles files;
    save_png(picture, file, files);
    files.commit();
}

void save_png(const Picture& picture, const std::filesystem::path& file, io::AtomicFiles& files) {
    if (picture.width < 1 || picture.height < 1 ||
        picture.rgb.size() != std::size_t{3} * static_cast<std::size_t>(picture.width) * picture.height)
        throw Error(io::about(file, "the picture to write is empty or not width x height x 3 bytes"));
    files.add(file).write(encoded(picture));
}

}  // namespace goffer::view
