// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "pixels.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

/// Pictures of bent models: their size, and where they are seen from.

using namespace goffer;
using namespace goffer::test;

namespace {

/// Takes a picture of a body that bends by 90 degrees.
Pixels picture(const Folder& folder, const Words& words) {
    (void)well(folder,
               Words{"bend", "base.ply", "--angle", "90", "-o", "out.ply", "--png", "out.png"} + words);
    return Pixels(folder / "out.png");
}

/// Which pixels show the body, which is red; the background is gray.
std::vector<bool> silhouette(const Pixels& pixels) {
    std::vector<bool> body;
    for (std::size_t y = 0; y < pixels.height; ++y) {
        for (std::size_t x = 0; x < pixels.width; ++x) {
            const auto [red, green, blue] = pixels.at(x, y);
            body.push_back(red > blue + 20 && red > green);
        }
    }
    return body;
}

/// The share of pixels where two silhouettes differ, the second one mirrored.
double differ(const Pixels& a, const Pixels& b, bool left_right, bool top_bottom) {
    const std::vector<bool> first = silhouette(a), second = silhouette(b);
    REQUIRE(first.size() == second.size());
    std::size_t off = 0, all = 0;
    for (std::size_t y = 0; y < a.height; ++y) {
        for (std::size_t x = 0; x < a.width; ++x) {
            const std::size_t to_x = left_right ? a.width - 1 - x : x,
                              to_y = top_bottom ? a.height - 1 - y : y;
            off += first[y * a.width + x] != second[to_y * a.width + to_x] ? 1 : 0;
            all += first[y * a.width + x] ? 1 : 0;
        }
    }
    REQUIRE(all > first.size() / 20);
    return static_cast<double>(off) / static_cast<double>(all);
}

}  // namespace

TEST_CASE("pictures: as large as asked") {
    const Folder folder;
    base(folder);
    const Pixels plain = picture(folder, {}), small = picture(folder, {"--size", "321x123"});
    CHECK(plain.width == 1280);
    CHECK(plain.height == 960);
    CHECK(small.width == 321);
    CHECK(small.height == 123);
    (void)well(folder, {"crowd", "base.ply", "--instances", "3", "--frames", "1", "--png", "out.png",
                        "--size", "200x100"});
    const Pixels crowd(folder / "out.png");
    CHECK(crowd.width == 200);
    CHECK(crowd.height == 100);
}

TEST_CASE("pictures: seen from where it is asked to be") {
    const Folder folder;
    base(folder);
    const Words small{"--size", "320x240"};
    const auto from = [&](const std::string& camera) {
        return picture(folder, small + Words{"--camera", camera});
    };
    CHECK(picture(folder, small).bytes == from("0,35").bytes);
    CHECK(from("side").bytes == from("0,0").bytes);
    CHECK(from("inner").bytes == from("0,90").bytes);
    CHECK(from("front").bytes == from("90,0").bytes);
    CHECK(from("front").bytes == from("450,0").bytes);
    // The plane that it bends in is one of symmetry.
    CHECK(differ(from("side"), from("180,0"), true, false) < 0.02);
    CHECK(differ(from("inner"), from("inner"), false, true) < 0.02);
    CHECK(differ(from("front"), from("front"), true, false) < 0.02);
    // Seen from the side it is not.
    CHECK(differ(from("side"), from("side"), false, true) > 0.2);
    CHECK(differ(from("side"), from("side"), true, false) > 0.2);
}

TEST_CASE("pictures: the plane that a body bends in is that of all its regions") {
    const Folder folder;
    base(folder);
    const auto seen = [&](const std::string& angles, const std::string& directions) {
        (void)well(folder, {"bend", "base.ply", "--regions", "0.5,0.5", "--angles", angles, "--directions",
                            directions, "--camera", "side", "--size", "200x150", "--png", "out.png"});
        return Pixels(folder / "out.png");
    };
    const Pixels bent = seen("0,70", "90,90");
    CHECK(differ(seen("0,70", "0,90"), bent, false, false) < 0.01);
    CHECK(differ(seen("0,-70", "0,270"), bent, false, false) < 0.01);
    CHECK(differ(seen("10,70", "0,90"), bent, false, false) < 0.1);
    CHECK(differ(seen("0,70", "0,90"), seen("70,0", "90,0"), false, false) > 0.2);
    // An S lies in its plane, too, whichever way its directions are said.
    const Pixels s_shape = seen("50,-50", "90,90");
    for (const std::string directions : {"-270,450", "450,-270"})
        CHECK(differ(seen("50,-50", directions), s_shape, false, false) < 0.01);
    CHECK(differ(seen("50,50", "90,270"), s_shape, false, false) < 0.01);
    CHECK(differ(seen("50,-50", "270,270"), seen("50,-50", "-90,-90"), false, false) < 0.01);
    CHECK(differ(seen("50,-50", "0,0"), seen("-50,50", "180,180"), false, false) < 0.01);
    // Where no plane is nearest, a little more or less of a bend makes no other picture.
    const Pixels corner = seen("60,60", "0,90");
    CHECK(differ(seen("60,60.01", "0,90"), corner, false, false) < 0.01);
    CHECK(differ(seen("60.01,60", "0,90"), corner, false, false) < 0.01);
}
