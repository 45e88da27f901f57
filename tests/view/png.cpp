// SPDX-License-Identifier: MIT
#include "support/files.hpp"

#include <goffer/io/error.hpp>
#include <goffer/view/picture.hpp>

#include <doctest/doctest.h>
#include <png.h>

#include <random>

using namespace goffer;
using namespace goffer::test;
namespace fs = std::filesystem;

namespace {

view::Picture noise(int width, int height) {
    view::Picture picture{width, height, {}};
    std::mt19937 random(7);
    for (int i = 0; i < width * height * 3; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(random()));
    return picture;
}

}  // namespace

TEST_CASE("a PNG reads back as it was") {
    const Folder folder;
    const auto picture = noise(123, 45);
    view::save_png(picture, folder / "a.png");
    CHECK(folder.files() == 1);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()) != 0);
    CHECK(image.width == 123);
    CHECK(image.height == 45);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr) != 0);
    CHECK(rgb == picture.rgb);
}

TEST_CASE("an existing picture is replaced as a whole, or left as it was") {
    const Folder folder;
    const fs::path file = folder.write("a.png", "old");
    {
        const FullDisk full(1000);
        CHECK_THROWS_AS(view::save_png(noise(100, 100), file), io::Error);
    }
    CHECK(bytes_of(file) == "old");
    CHECK(folder.files() == 1);

    view::save_png(noise(10, 10), file);
    CHECK(bytes_of(file).substr(1, 3) == "PNG");
    CHECK(folder.files() == 1);
}

TEST_CASE("a picture takes the place that a link leads to, with the permissions of the old one") {
    const Folder folder;
    const auto mine = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(folder.write("real.png", "old"), mine);
    fs::create_symlink("real.png", folder / "link.png");
    view::save_png(noise(10, 10), folder / "link.png");
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(bytes_of(folder / "real.png").substr(1, 3) == "PNG");
    CHECK(fs::status(folder / "real.png").permissions() == mine);
}

TEST_CASE("where no file can be, one line says so") {
    const Folder folder;
    fs::create_directory(folder / "taken.png");
    folder.write("file", "x");
    const auto error = [](const fs::path& file) {
        return message_of<io::Error>([&] { view::save_png(noise(4, 4), file); });
    };
    CHECK(tells(error(folder / "taken.png"), "taken.png: is a folder"));
    CHECK(tells(error(folder / "none/a.png"), "a.png: there is no such folder"));
    CHECK(tells(error(folder / "file/a.png"), "a.png: there is no such folder"));
    CHECK(error("/dev/null").starts_with("/dev/null: is not a regular file"));
    CHECK(folder.files() == 2);
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a picture without pixels, or with too few bytes, is refused") {
    const Folder folder;
    CHECK_THROWS_AS(view::save_png({}, folder / "a.png"), view::Error);
    CHECK_THROWS_AS(view::save_png({2, 2, std::vector<std::uint8_t>(11)}, folder / "a.png"), view::Error);
    CHECK(folder.files() == 0);
}
