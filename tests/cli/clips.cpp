// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

/// What `goffer animate` says of a clip in one file.

using namespace goffer;
using namespace goffer::test;

namespace {

/// Animated glTF of a body that swings: what is said on standard error, which is one line or nothing.
std::string warned(const Folder& folder, const Words& words) {
    const Result result =
        run(folder, Words{"animate", "base.ply", "-o", "worm.glb", "--swing", "90"} + words);
    CHECK(result.code == 0);
    CHECK(std::ranges::count(result.err, '\n') == (result.err.empty() ? 0 : 1));
    return result.err;
}

bool holds(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("animate: shapes that are not as near as --max-error asks are warned of, with what mends it") {
    const Folder folder;
    base(folder);
    const Words frames{"--frames", "60"};
    CHECK(holds(warned(folder, frames + Words{"--max-error", "0.1", "--targets", "3"}),
                " % of the size, more than --max-error 0.1: allow more --targets"));
    CHECK(holds(warned(folder, frames + Words{"--max-error", "0", "--targets", "50"}),
                "the rounding of floats; give a larger one"));
    CHECK(warned(folder, frames + Words{"--max-error", "0.1"}).empty());
}

TEST_CASE("animate: without --max-error, how near shapes are is reported, and not warned of") {
    const Folder folder;
    base(folder);
    for (const Words& words : {Words{"--targets", "50"}, Words{"--targets", "2"}, Words{}})
        CHECK(warned(folder, Words{"--frames", "60"} + words).empty());
}

TEST_CASE("animate: a clip of few frames takes no more shapes than --max-error asks for") {
    const Folder folder;
    base(folder);
    folder.write("keys.csv",
                 "time,angle1,direction1,angle2,direction2\n0,0,0,0,0\n1,150,90,-80,200\n2,-120,40,160,-60\n"
                 "3,90,250,90,10\n4,-160,120,40,300\n5,60,330,-170,70\n6,170,200,120,150\n");
    const auto gltf = [&](const Words& words) {
        const Words keys{"animate", "base.ply", "-o", "worm.glb", "--keys", "keys.csv", "--fps", "1"};
        return report(folder, keys + Words{"--interpolation", "linear"} + words)["gltf"];
    };
    const nlohmann::json near = gltf({"--max-error", "10"});
    CHECK(near["within"] == true);
    CHECK(near["targets"] == 6);
    CHECK(gltf({"--max-error", "10", "--targets", "5"})["within"] == false);
    CHECK(gltf({"--max-error", "0.1"})["targets"] == 7);
}
