// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "mesh/gltf_files.hpp"
#include "pixels.hpp"
#include "support/png.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

/// Textures in pictures.

using namespace goffer::test;

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
    return png_of(2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 255});
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

TEST_CASE("textures: they are seen where they belong, bent and refined, and of a crowd") {
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

TEST_CASE("textures: an image that is broken is warned of, where a picture is wanted") {
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
    CHECK(warnings(said).dump().find("is not shown: the PNG is broken") != std::string::npos);
    const auto seen = seen_in(folder / "out.png");
    CHECK(seen[2].count == 0);
}

TEST_CASE("textures: one in the folder one works in, named by a document named without its folder") {
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
