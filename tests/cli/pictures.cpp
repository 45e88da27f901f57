// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "pixels.hpp"
#include "support/models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

using namespace goffer;
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

TEST_CASE("pictures: vertices of a glTF have their colors whatever the name of its file") {
    const Folder folder;
    base(folder, "tube.ply");
    mesh::Mesh mesh = mesh::load(folder / "tube.ply");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.colors.emplace_back(0.2f + 0.5f * static_cast<float>(i % 2), 0.3f, 0.1f, 1.0f);
    mesh.source = nullptr;
    mesh::save(mesh, folder / "tube.glb");
    std::filesystem::copy_file(folder / "tube.glb", folder / "tube.GLB");
    std::filesystem::copy_file(folder / "tube.glb", folder / "tube.bin");
    const auto picture = [&](const std::string& name) {
        well(folder, {"bend", name, "-o", "out.obj", "--png", "out.png", "--size", "160x120"});
        return bytes_of(folder / "out.png");
    };
    CHECK(picture("tube.GLB") == picture("tube.glb"));
    CHECK(picture("tube.bin") == picture("tube.glb"));
}
