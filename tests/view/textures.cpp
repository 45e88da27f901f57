// SPDX-License-Identifier: MIT
#include "images.hpp"
#include "shapes.hpp"

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

#include <limits>
#include <memory>
#include <string>
#include <vector>

/// Textures on models, pixel by pixel.

using namespace goffer;
using namespace goffer::test;

namespace {

// Red and green above, blue and white below.
const Rgb four{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

view::Texture texture_of(int width, int height, const Rgb& rgb, view::Wrap wrap = view::Wrap::clamp) {
    return {.image = std::make_shared<view::MipMap>(image_of(width, height, rgb)),
            .wrap_u = wrap,
            .wrap_v = wrap,
            .nearest = true};
}

const view::Settings settings{200, 200, 4};

/// A square from above, in which the picture's middle is its own; its corners are at these coordinates.
view::Picture board(const view::Texture& texture, float low, float high) {
    const Shape shape = square({0, 0, 0}, 1);
    const std::vector<glm::vec2> corners{{low, low}, {high, low}, {high, high}, {low, high}};
    std::vector<glm::vec2> uvs;
    for (const std::uint32_t vertex : shape.triangles) uvs.push_back(corners[vertex]);
    view::Model model = shape.model();
    model.color = glm::vec4(0.75f, 0.75f, 0.75f, 1);
    model.texture = texture;
    model.uvs = uvs;
    return view::render({&model, 1}, from_above, settings);
}

/// R, G, B or W, by what is brightest; a dot for none of them.
char letter(const glm::ivec3& c) {
    if (std::min({c.r, c.g, c.b}) > 150) return 'W';
    if (c.r > c.g + 80 && c.r > c.b + 80) return 'R';
    if (c.g > c.r + 80 && c.g > c.b + 80) return 'G';
    return c.b > c.r + 80 && c.b > c.g + 80 ? 'B' : '.';
}

/// What the board shows at the middles of n x n equal squares, row after row from the top.
std::string letters(const view::Picture& picture, int n) {
    std::string text;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const auto at = [&](int i) { return static_cast<int>(100 + 180 * ((i + 0.5) / n - 0.5)); };
            text += letter(pixel(picture, at(column), at(row)));
        }
    return text;
}

}  // namespace

TEST_CASE("textures: each corner has its color, u to the right and v up") {
    CHECK(letters(board(texture_of(2, 2, four), 0, 1), 2) == "RGBW");
    const view::Image jpeg = view::decode_image(jpeg_of(16, 16, [] {
        Rgb rgb;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                for (int c = 0; c < 3; ++c)
                    rgb.push_back(four[static_cast<std::size_t>(6 * (y / 8) + 3 * (x / 8) + c)]);
        return rgb;
    }()));
    CHECK(letters(board({.image = std::make_shared<view::MipMap>(jpeg)}, 0, 1), 2) == "RGBW");
}

TEST_CASE("textures: beyond 0 to 1 they are repeated, mirrored, or go on as they end") {
    CHECK(letters(board(texture_of(2, 2, four, view::Wrap::repeat), -1, 1), 4) == "RGRGBWBWRGRGBWBW");
    CHECK(letters(board(texture_of(2, 2, four, view::Wrap::mirror), -1, 1), 4) == "GRRGWBBWWBBWGRRG");
    CHECK(letters(board(texture_of(2, 2, four, view::Wrap::clamp), -1, 1), 4) == "RRRGBBBWBBBWBBBW");
}

TEST_CASE("textures: on a seam each side has its own coordinates, though they share vertices") {
    // Six vertices, two squares; on the line between them one side ends at 1 and the other begins at 0.
    Shape shape;
    for (const float y : {-0.5f, 0.5f})
        for (const float x : {-1.0f, 0.0f, 1.0f}) shape.positions.emplace_back(x, y, 0);
    shape.triangles = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    const glm::vec2 a(0, 0), b(1, 0), c(1, 1), d(0, 1);
    const std::vector<glm::vec2> uvs{a, b, c, a, c, d, a, b, c, a, c, d};
    view::Model model = shape.model();
    model.color = glm::vec4(0.75f, 0.75f, 0.75f, 1);
    model.texture = texture_of(4, 1, {255, 0, 0, 255, 0, 0, 0, 255, 0, 0, 255, 0});
    model.uvs = uvs;
    const view::Picture picture = view::render({&model, 1}, from_above, settings);
    std::string seen;
    for (const int x : {20, 45, 60, 90, 98, 102, 110, 140, 155, 180}) seen += letter(pixel(picture, x, 100));
    CHECK(seen == "RRGGGRRRGG");
    // A slanted one is as smooth as an edge.
    const view::Picture slanted = view::render({&model, 1}, {{0, 0, -1}, {0.2f, 1, 0}, 0.5f}, settings);
    int between = 0;
    for (int y = 80; y < 120; ++y)
        for (int x = 85; x < 115; ++x) between += letter(pixel(slanted, x, y)) == '.' ? 1 : 0;
    CHECK(between > 8);
    CHECK(between < 80);
}

TEST_CASE("textures: what is finer than a pixel is its mean, seen straight and from the side") {
    constexpr int side = 512;
    Rgb checks;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) checks.insert(checks.end(), 3, (x + y) % 2 == 0 ? 255 : 0);
    const view::Texture texture = texture_of(side, side, checks, view::Wrap::repeat);
    const view::Texture gray = texture_of(1, 1, {188, 188, 188});  // half of the light
    for (const float high : {1.5f, 5.3f}) {
        CAPTURE(high);
        CHECK(difference(board(texture, 0, high), board(gray, 0, high), 3) < 0.001);
    }
}

TEST_CASE("textures: a stripe seen at a grazing angle stays, where it is wide enough across") {
    // Stripes along the view: from the side they are as wide as ever, and must not be blended away.
    Rgb stripes;
    for (int i = 0; i < 64 * 64; ++i) stripes.insert(stripes.end(), 3, i % 8 < 4 ? 255 : 0);
    view::Texture texture = texture_of(64, 64, stripes, view::Wrap::repeat);
    texture.nearest = false;
    const Shape shape = square({0, 0, 0}, 1);
    const std::vector<glm::vec2> corners{{0, 0}, {1, 0}, {1, 8}, {0, 8}};
    std::vector<glm::vec2> uvs;
    for (const std::uint32_t vertex : shape.triangles) uvs.push_back(corners[vertex]);
    view::Model model = shape.model();
    model.texture = texture;
    model.uvs = uvs;
    const view::Picture picture = view::render({&model, 1}, {{0, 1, -0.15f}, {0, 0, 1}, 0.5f}, {400, 200, 4});
    int low = 255, high = 0;
    for (int x = 180; x < 220; ++x) {
        const int brightness = pixel(picture, x, 85).r;
        low = std::min(low, brightness);
        high = std::max(high, brightness);
    }
    CHECK(high - low > 60);
}

TEST_CASE("textures: colors are multiplied, and coordinates that are not finite do no harm") {
    const Shape shape = square({0, 0, 0}, 1);
    const std::vector<glm::vec4> colors(4, {1, 0, 0, 1});
    const float inf = std::numeric_limits<float>::infinity();
    std::vector<glm::vec2> uvs(6, {0.75f, 0.25f});  // white
    view::Model model = shape.model();
    model.color = glm::vec4(0.75f, 0.75f, 0.75f, 1);
    model.colors = colors;
    model.texture = texture_of(2, 2, four);
    model.uvs = uvs;
    CHECK(letter(pixel(view::render({&model, 1}, from_above, settings), 100, 100)) == 'R');
    for (const view::Wrap wrap : {view::Wrap::repeat, view::Wrap::mirror, view::Wrap::clamp}) {
        model.texture.wrap_u = model.texture.wrap_v = wrap;
        for (const float wild : {inf, -inf, std::nanf(""), 1e20f, 1e30f, -3e38f}) {
            uvs.assign(6, {wild, wild});
            uvs[1] = {0, wild};
            const view::Picture picture = view::render({&model, 1}, from_above, settings);
            CHECK(letter(pixel(picture, 100, 100)) != 'K');  // black: a sum that is not finite
        }
    }
    model.uvs = std::span(uvs).first(5);
    CHECK_THROWS_AS((void)view::render({&model, 1}, from_above, settings), view::Error);
}
