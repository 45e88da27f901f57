// SPDX-License-Identifier: MIT
#include "shapes.hpp"

#include <doctest/doctest.h>
#include <png.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <random>

using namespace goffer;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("goffer-view-" + std::to_string(std::random_device{}()));
    Folder() { fs::create_directory(path); }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(path), {}); }
};

// Files cannot grow beyond `bytes` while this lives, as on a full disc.
class FullDisc {
public:
    explicit FullDisc(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~FullDisc() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisc(const FullDisc&) = delete;
    FullDisc& operator=(const FullDisc&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int);
};

view::Picture noise(int width, int height) {
    view::Picture picture{width, height, {}};
    std::mt19937 random(7);
    for (int i = 0; i < width * height * 3; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(random()));
    return picture;
}

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a PNG reads back as it was") {
    const Folder folder;
    const auto picture = noise(123, 45);
    view::save_png(picture, folder.path / "a.png");
    CHECK(folder.files() == 1);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, (folder.path / "a.png").c_str()) != 0);
    CHECK(image.width == 123);
    CHECK(image.height == 45);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr) != 0);
    CHECK(rgb == picture.rgb);
}

TEST_CASE("an existing picture is replaced as a whole, or left as it was") {
    const Folder folder;
    const fs::path file = folder.path / "a.png";
    std::ofstream(file) << "old";
    {
        const FullDisc full(1000);
        CHECK_THROWS_AS(view::save_png(noise(100, 100), file), view::Error);
    }
    CHECK(content(file) == "old");
    CHECK(folder.files() == 1);

    view::save_png(noise(10, 10), file);
    CHECK(content(file).substr(1, 3) == "PNG");
    CHECK(folder.files() == 1);
}

TEST_CASE("where no file can be, one line says so") {
    const Folder folder;
    fs::create_directory(folder.path / "taken.png");
    std::ofstream(folder.path / "file") << "x";
    for (const fs::path& file : {folder.path / "taken.png", folder.path / "none" / "a.png",
                                 folder.path / "file" / "a.png", fs::path("/dev/null"), fs::path()}) {
        CAPTURE(file.string());
        std::string what;
        try {
            view::save_png(noise(4, 4), file);
        } catch (const view::Error& error) {
            what = error.what();
        }
        CHECK(what.find(file.string()) != std::string::npos);
        CHECK(what.find("cannot be written") != std::string::npos);
        CHECK(what.find('\n') == std::string::npos);
    }
    CHECK(folder.files() == 2);
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a picture without pixels, or with too few bytes, is refused") {
    const Folder folder;
    CHECK_THROWS_AS(view::save_png({}, folder.path / "a.png"), view::Error);
    CHECK_THROWS_AS(view::save_png({2, 2, std::vector<std::uint8_t>(11)}, folder.path / "a.png"),
                    view::Error);
    CHECK(folder.files() == 0);
}
