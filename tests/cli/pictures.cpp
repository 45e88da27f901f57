// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "mesh/gltf_files.hpp"
#include "pixels.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

using namespace goffer::test;

namespace {

/// The brightness of every pixel.
std::vector<png_byte> gray_of(const std::filesystem::path& file) {
    const Pixels pixels(file, PNG_FORMAT_GRAY);
    CHECK(pixels.width == 1280);
    CHECK(pixels.height == 960);
    return pixels.bytes;
}

/// The solid's share of the picture: what is darker than the background and a ghost on it.
double covered(const std::filesystem::path& file) {
    const std::vector<png_byte> pixels = gray_of(file);
    const auto solid = std::ranges::count_if(pixels, [](png_byte p) { return p < 190; });
    return static_cast<double>(solid) / static_cast<double>(pixels.size());
}

/// The share of pixels that differ clearly.
double differing(const std::vector<png_byte>& a, const std::vector<png_byte>& b) {
    REQUIRE(a.size() == b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 4 ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(a.size());
}

/// Bends a model, takes its picture, and checks that the model fills a good part of it; how much.
double check_picture(const char* name, const Words& more = {}) {
    const std::filesystem::path file = model(name);
    if (file.empty()) return 0;
    CAPTURE(name);
    const Folder folder;
    const std::string picture = "é ö.PNG";
    (void)report(folder, Words{"bend", file.string(), "-o", name, "--png", picture} + more);
    CHECK(folder.files() == 2);
    const double share = covered(folder / picture);
    CAPTURE(share);
    CHECK(share > 0.05);
    CHECK(share < 0.9);
    return share;
}

}  // namespace

TEST_CASE("pictures: banana.obj") {
    check_picture("banana.obj");
}

TEST_CASE("pictures: fuze.ply, with a ghost there is more to frame") {
    const double plain = check_picture("fuze.ply");
    if (plain == 0) return;  // not at hand
    CHECK(check_picture("fuze.ply", {"--ghost"}) < 0.9 * plain);
}

TEST_CASE("pictures: lh_trochanterfemur.stl, in tiny units") {
    check_picture("lh_trochanterfemur.stl");
}

TEST_CASE("pictures: insect_leg.glb, of several primitives, materials and nodes") {
    check_picture("insect_leg.glb");
}

TEST_CASE("pictures: WaterBottle.gltf") {
    check_picture("WaterBottle.gltf");
}

TEST_CASE("pictures: a crowd, in whatever form it was written") {
    const Folder folder;
    base(folder, "base.ply", {"--columns", "24", "--rows", "81"});
    const auto picture = [&](const std::string& streams) {
        (void)report(folder, {"crowd", "base.ply", "--instances", "6", "--frames", "30", "--streams", streams,
                              "--png", "out.png"});
        return gray_of(folder / "out.png");
    };
    const std::vector<png_byte> planar = picture("planar");
    const std::vector<png_byte> packed = picture("packed");
    const double share = covered(folder / "out.png");
    CAPTURE(share);
    CHECK(share > 0.05);
    CHECK(share < 0.9);
    // Packed positions are off by some 1e-5, and so some pixels on edges.
    CHECK(differing(planar, packed) < 3e-4);
    CHECK(planar != packed);
}

TEST_CASE("pictures: a crowd's regions are put together as the model is") {
    const Folder folder;
    // A C, row after row from one end: with the axis turned round, regions reverse them.
    base(folder, "base.ply", {"--columns", "24", "--rows", "81"});
    well(folder, {"bend", "base.ply", "--folds", "0", "-o", "c.ply"});
    const auto picture = [&](const Words& more) {
        (void)report(folder, Words{"crowd", "c.ply", "--rest", "straight", "--instances", "1", "--frames",
                                   "1", "--angle", "0", "--axis", "-z", "--png", "out.png"} +
                                 more);
        return gray_of(folder / "out.png");
    };
    CHECK(differing(picture({"--regions", "0.5,0.5"}), picture({})) < 1e-3);
}

TEST_CASE("pictures: vertices have the colors that the file gives them, one by one and in a crowd") {
    const Folder folder;
    // A tube of 8 x 21 vertices, green below and blue above; and the same all in white, which says nothing.
    const auto write = [&](const std::string& name, bool colored) {
        std::ofstream file(folder / name);
        for (int row = 0; row <= 20; ++row) {
            for (int column = 0; column < 8; ++column) {
                const double turn = column * std::numbers::pi / 4;
                file << "v " << std::cos(turn) << ' ' << std::sin(turn) << ' ' << 0.5 * row
                     << (!colored   ? " 1 1 1\n"
                         : row < 10 ? " 0.1 0.7 0.1\n"
                                    : " 0.1 0.1 0.7\n");
            }
        }
        for (int row = 0; row < 20; ++row) {
            for (int column = 0; column < 8; ++column) {
                const int a = 8 * row + column + 1, b = 8 * row + (column + 1) % 8 + 1;
                file << "f " << a << ' ' << b << ' ' << b + 8 << ' ' << a + 8 << '\n';
            }
        }
    };
    write("tube.obj", true);
    write("white.obj", false);
    const auto count = [&](int channel, int than) {
        const Pixels pixels(folder / "out.png");
        int found = 0;
        for (std::size_t y = 0; y < pixels.height; ++y) {
            for (std::size_t x = 0; x < pixels.width; ++x) {
                const auto color = pixels.at(x, y);
                const auto c = static_cast<std::size_t>(channel), t = static_cast<std::size_t>(than);
                found += color[c] > color[t] + 40 ? 1 : 0;
            }
        }
        return found;
    };
    constexpr int red = 0, green = 1, blue = 2;
    well(folder, {"bend", "tube.obj", "-o", "out.obj", "--png", "out.png", "--size", "320x240"});
    CHECK(count(green, red) > 1000);
    CHECK(count(blue, red) > 1000);
    CHECK(count(red, blue) == 0);
    well(folder, {"crowd", "tube.obj", "--folds", "0", "--instances", "3", "--frames", "1", "--png",
                  "out.png", "--size", "320x240"});
    CHECK(count(green, red) > 500);
    CHECK(count(blue, red) > 500);
    CHECK(count(red, blue) == 0);
    well(folder, {"bend", "white.obj", "-o", "out.obj", "--png", "out.png", "--size", "320x240"});
    CHECK(count(red, blue) > 2000);  // clay
}

namespace {

/// What a picture shows of the pure colors, and where on the average, from left to right.
struct Seen {
    std::size_t count = 0;
    double x = 0;
};

std::array<Seen, 3> seen_in(const std::filesystem::path& file) {
    const Pixels pixels(file);
    std::array<Seen, 3> seen;
    for (std::size_t y = 0; y < pixels.height; ++y) {
        for (std::size_t x = 0; x < pixels.width; ++x) {
            const auto color = pixels.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                if (color[c] < color[(c + 1) % 3] + 50 || color[c] < color[(c + 2) % 3] + 50) continue;
                ++seen[c].count;
                seen[c].x += static_cast<double>(x);
            }
        }
    }
    for (Seen& color : seen) color.x /= static_cast<double>(std::max<std::size_t>(color.count, 1));
    return seen;
}

/// A PNG of 2 x 2 pixels: red and green above, blue below.
std::string small_image() {
    const std::array<png_byte, 12> rgb{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 255};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 2;
    image.format = PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    REQUIRE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) != 0);
    bytes.resize(size);
    return bytes;
}

/// A tube along z of 5 rows of 16 columns, with that image inside: u once around it, v up along it. Too
/// coarse to wrinkle, so that it is refined.
std::string textured_tube() {
    Document document;
    std::vector<float> points, uvs;
    std::vector<std::uint16_t> indices;
    constexpr int columns = 16, rows = 4;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const double turn = 2 * std::numbers::pi * column / columns;
            for (const double value : {std::cos(turn), std::sin(turn), 10.0 * row / rows})
                points.push_back(static_cast<float>(value));
            uvs.push_back(static_cast<float>(column) / columns);
            uvs.push_back(1 - static_cast<float>(row) / rows);  // glTF's v points down
        }
    }
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int a = (columns + 1) * row + column, b = a + columns + 1;
            for (const int vertex : {a, a + 1, b + 1, a, b + 1, b})
                indices.push_back(static_cast<std::uint16_t>(vertex));
        }
    }
    Json primitive;
    primitive["attributes"] = {{"POSITION", document.floats(points, "VEC3")},
                               {"TEXCOORD_0", document.floats(uvs, "VEC2")}};
    primitive["indices"] = document.shorts(indices);
    primitive["material"] = 0;
    document.json["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
    document.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
    document.json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    document.json["scene"] = 0;
    const std::size_t view = document.view(small_image());
    document.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    document.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
    document.json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33071, "magFilter": 9728}])");
    document.json["materials"] =
        Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    return document.glb();
}

}  // namespace

TEST_CASE("pictures: textures are seen where they belong, bent and refined, and of a crowd") {
    const Folder folder;
    folder.write("tube.glb", textured_tube());
    const auto bend = [&](const Words& more) {
        const nlohmann::json said = report(
            folder, Words{"bend", "tube.glb", "-o", "out.glb", "--axis", "z", "--angle", "60", "--direction",
                          "90", "--camera", "side", "--png", "out.png", "--size", "320x240"} +
                        more);
        return seen_in(folder / "out.png");
    };
    for (const char* refine : {"on", "off"}) {
        CAPTURE(refine);
        // Bent toward y, and looked at along -x: what is at u = 0 and 1, half of it red and half green.
        const auto [red, green, blue] = bend({"--refine", refine});
        CHECK(red.count > 2000);
        CHECK(green.count > 2000);
        CHECK(blue.count > 4000);
        CHECK(blue.x + 80 < red.x);  // from the base, at the left, to the tip
        CHECK(blue.x + 80 < green.x);
        const auto both = static_cast<double>(red.count + green.count);
        CHECK(both == doctest::Approx(static_cast<double>(blue.count)).epsilon(0.25));
    }
    const auto [red, green, blue] = bend({"--show", "area"});
    CHECK(green.count == 0);
    (void)report(folder, {"crowd", "tube.glb", "--axis", "z", "--instances", "4", "--frames", "1", "--png",
                          "out.png", "--size", "320x240"});
    const auto crowd = seen_in(folder / "out.png");
    for (const Seen& color : crowd) CHECK(color.count > 300);
}

TEST_CASE("pictures: an image that is broken is warned of, where a picture is wanted") {
    const Folder folder;
    std::string tube = textured_tube();
    tube[tube.find("IHDR")] = 'X';
    folder.write("tube.glb", tube);
    const nlohmann::json quiet = report(folder, {"bend", "tube.glb", "-o", "out.glb"});
    const nlohmann::json said = report(folder, {"bend", "tube.glb", "-o", "out.glb", "--png", "out.png"});
    const auto warnings = [](const nlohmann::json& of) {
        return of.value("warnings", nlohmann::json::array());
    };
    CHECK(warnings(said).size() == warnings(quiet).size() + 1);
    CHECK(warnings(said).dump().find("a texture is not shown: the PNG is broken") != std::string::npos);
    const auto seen = seen_in(folder / "out.png");
    CHECK(seen[2].count == 0);
}

TEST_CASE("pictures: a texture in the folder one works in, named by a document named without its folder") {
    const Folder folder;
    Document document = opened(textured_tube());
    document.json.erase("buffers");
    document.json["images"][0] = {{"uri", "image.png"}};
    folder.write("image.png", small_image());
    folder.write("tube.gltf", document.gltf());
    (void)report(folder, {"bend", "tube.gltf", "-o", "out.gltf", "--png", "out.png", "--size", "320x240"});
    CHECK(seen_in(folder / "out.png")[2].count > 1000);
    CHECK(bytes_of(folder / "out.gltf").find("\"image.png\"") != std::string::npos);
}
