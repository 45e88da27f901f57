// SPDX-License-Identifier: MIT
#include <goffer/view/picture.hpp>

#include <png.h>

#include <cerrno>
#include <fstream>
#include <random>
#include <string>
#include <system_error>

namespace goffer::view {
namespace {

namespace fs = std::filesystem;

std::vector<char> encoded(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;

    std::vector<char> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr))
        throw Error(std::string("the picture cannot be packed as PNG: ") + image.message);
    bytes.resize(size);
    return bytes;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw Error(file.string() + ": cannot be written: " + why + "; give a file in a folder you can write to");
}

fs::path beside(const fs::path& file) {
    fs::path name = file;
    name += '.';
    name += std::to_string(std::random_device{}());
    name += ".part";
    return name;
}

bool write(const fs::path& file, const std::vector<char>& bytes) {
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    return !out.fail();
}

}  // namespace

void save_png(const Picture& picture, const std::filesystem::path& file) {
    if (picture.width < 1 || picture.height < 1 ||
        picture.rgb.size() != std::size_t{3} * static_cast<std::size_t>(picture.width) * picture.height)
        throw Error(file.string() + ": the picture to write is empty or not width x height x 3 bytes");
    const std::vector<char> bytes = encoded(picture);

    std::error_code error;
    if (fs::exists(file, error) && !fs::is_regular_file(file, error))
        refuse(file, "it is there and not a plain file");
    const fs::path part = beside(file);
    if (!write(part, bytes)) {
        const std::string why = std::system_category().message(errno);
        fs::remove(part, error);
        refuse(file, why);
    }
    fs::rename(part, file, error);
    if (!error) return;
    const std::string why = error.message();
    fs::remove(part, error);
    refuse(file, why);
}

}  // namespace goffer::view
