// SPDX-License-Identifier: MIT
#include "shapes.hpp"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

using namespace goffer;
using test::from_above;

namespace {

test::Shape scaled(test::Shape shape, float factor) {
    for (glm::vec3& p : shape.positions) p *= factor;
    return shape;
}

const view::Settings small{240, 180, 8};

}  // namespace

TEST_CASE("the same bytes, whatever the threads") {
    const test::Shape bumpy = test::sphere({0, 0, 0}, 1, 300, 150, 0.05f);
    test::Shape ghost = test::sphere({0.2f, 0, 0}, 1, 300, 150, 0.05f), same_place = bumpy;
    ghost.color.a = 0.3f;
    same_place.color = {0, 0.5f, 0, 1};
    const auto pictured = [&](int threads) {
        return tbb::task_arena(threads).execute([&] {
            return test::render({bumpy, ghost, same_place}, small).rgb;
        });
    };
    const auto one = pictured(1);
    CHECK(pictured(2) == one);
    CHECK(pictured(4) == one);
}

TEST_CASE("a picture tells how many of its rows are done, and is not changed by that") {
    const test::Shape bumpy = test::sphere({0, 0, 0}, 1, 120, 60, 0.05f);
    view::Settings high{32, 1024, 1};
    const auto unheard = test::render({bumpy}, high).rgb;
    std::vector<double> shares;
    high.progress = [&](double share) { shares.push_back(share); };
    CHECK(test::render({bumpy}, high).rgb == unheard);
    CHECK(shares.size() >= 4);
    CHECK(shares.front() <= 0.25);
    CHECK(std::ranges::is_sorted(shares));
    CHECK(shares.back() == 1);
}

TEST_CASE("the scale of the world is not seen") {
    const test::Shape bumpy = test::sphere({0.3f, -2, 5}, 1, 120, 60, 0.05f);
    const auto plain = test::render({bumpy}, small);
    SUBCASE("powers of two, to the bit") {
        CHECK(test::render({scaled(bumpy, 0x1p-13f)}, small).rgb == plain.rgb);
        CHECK(test::render({scaled(bumpy, 0x1p13f)}, small).rgb == plain.rgb);
    }
    SUBCASE("others, within rounding") {
        CHECK(test::difference(test::render({scaled(bumpy, 1e-4f)}, small), plain, 2) < 0.002);
        CHECK(test::difference(test::render({scaled(bumpy, 1e4f)}, small), plain, 2) < 0.002);
    }
}

TEST_CASE("a ghost lies between the background and its own color") {
    test::Shape board = test::square({0, 0, 0}, 1);
    board.color = {0.1f, 0.15f, 0.2f, 1};
    const glm::ivec3 solid = test::pixel(test::render({board}, small, from_above), 120, 90);
    const glm::ivec3 background = test::pixel(test::render({board}, small, from_above), 2, 90);
    glm::ivec3 before = background;
    for (const float alpha : {0.2f, 0.5f, 0.8f}) {
        board.color.a = alpha;
        const glm::ivec3 ghost = test::pixel(test::render({board}, small, from_above), 120, 90);
        for (int c = 0; c < 3; ++c) {
            CHECK(ghost[c] < before[c]);
            CHECK(ghost[c] > solid[c] - 8);
        }
        before = ghost;
    }
}

TEST_CASE("a ghost is seen behind and in front of a solid, and hides where it touches one") {
    test::Shape board = test::square({0, 0, 0}, 0.5f), ghost = test::square({0, 0, 0}, 1);
    ghost.color = {0.05f, 0.1f, 0.9f, 0.5f};
    const auto middle = [&](float height) {
        for (glm::vec3& p : ghost.positions) p.z = height;
        return test::pixel(test::render({board, ghost}, small, from_above), 120, 90);
    };
    const glm::ivec3 touching = middle(0), behind = middle(-0.8f), before = middle(0.8f);
    CHECK(glm::all(glm::lessThanEqual(glm::abs(touching - behind), glm::ivec3(3))));
    CHECK(before.r < behind.r - 20);
}

TEST_CASE("solids cast shadows, ghosts do not") {
    const test::Shape floor = test::square({0, 0, 0}, 1);
    test::Shape lid = test::square({-0.2f, 0.3f, 0.4f}, 0.25f);
    const auto pictured = [&](float alpha) {
        lid.color.a = alpha;
        return test::render({floor, lid}, small, from_above);
    };
    const auto faint = pictured(0.001f);
    const double covered = test::difference(pictured(0.6f), faint, 3);
    const double darkened = test::difference(pictured(1), faint, 3);
    CHECK(covered > 0.01);
    CHECK(darkened > 1.5 * covered);
}

TEST_CASE("both sides of a surface look the same") {
    test::Shape ball = test::sphere({0, 0, 0}, 1, 96, 48);
    const auto plain = test::render({ball}, small);
    SUBCASE("turned triangles") {
        for (std::size_t i = 0; i < ball.triangles.size(); i += 3)
            std::swap(ball.triangles[i], ball.triangles[i + 1]);
    }
    SUBCASE("turned normals") {
        for (glm::vec3& n : ball.normals) n = -n;
    }
    CHECK(test::difference(test::render({ball}, small), plain, 2) < 0.002);
}

TEST_CASE("degenerate triangles and broken normals leave no mark") {
    test::Shape ball = test::sphere({0, 0, 0}, 1, 96, 48);
    const auto plain = test::render({ball}, small);
    for (std::uint32_t i = 300; i < 900; i += 3)
        ball.triangles.insert(ball.triangles.end(), {i, i, i, i, i + 1, i, i, i + 96, i});
    CHECK(test::difference(test::render({ball}, small), plain, 2) < 0.002);

    for (std::size_t i = 0; i < ball.normals.size(); i += 7)
        ball.normals[i] = glm::vec3(i % 2 ? std::nanf("") : 0.0f);
    const auto broken = test::render({ball}, small);
    for (std::size_t i = 0; i < broken.rgb.size(); i += 3)
        if (plain.rgb[i] > 40) REQUIRE(broken.rgb[i] > 20);  // no black holes
}

TEST_CASE("vertex colors multiply the model's color") {
    test::Shape board = test::square({0, 0, 0}, 1);
    board.color = {0.5f, 0.5f, 0.5f, 1};
    const std::vector<glm::vec4> red(4, glm::vec4(1, 0.1f, 0.1f, 1));
    view::Model model = board.model();
    model.colors = red;
    const glm::ivec3 seen = test::pixel(view::render({&model, 1}, from_above, small), 120, 90);
    CHECK(seen.r > 2 * seen.g);
    CHECK(std::abs(seen.g - seen.b) < 15);
}

TEST_CASE("smooth shading hides the facets, and no shadow shows them") {
    const test::Shape coarse = test::sphere({0, 0, 0}, 1, 24, 12), fine = test::sphere({0, 0, 0}, 1);
    const auto a = test::render({coarse}, small), b = test::render({fine}, small);
    test::Shape flat = coarse;
    flat.normals.clear();
    CHECK(test::difference(test::render({flat}, small), b, 3) > 16 * test::difference(a, b, 3));
}

TEST_CASE("where two colors meet on one surface, they blend") {
    test::Shape red = test::square({0, 0, 0}, 1), green = red;
    red.triangles = {0, 1, 2};
    green.triangles = {0, 2, 3};
    red.color = {0.7f, 0.05f, 0.05f, 1};
    green.color = {0.05f, 0.7f, 0.05f, 1};
    const view::Picture picture = test::render({red, green}, small, from_above);
    std::size_t blended = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        const int r = picture.rgb[i], g = picture.rgb[i + 1], b = picture.rgb[i + 2];
        blended += r > b + 30 && g > b + 30 && std::abs(r - g) < 100 ? 1 : 0;
    }
    CHECK(blended > 60);
}

TEST_CASE("few samples show what many do") {
    test::Shape board = test::square({0, 0, -1.2f}, 2.5f);
    board.color = {0.6f, 0.6f, 0.5f, 1};
    const test::Shape bumpy = test::sphere({0, 0, 0}, 1, 200, 100, 0.08f);
    view::Settings few{320, 240, 16}, many = few;
    many.samples = 1024;
    const view::Picture a = test::render({bumpy, board}, few), b = test::render({bumpy, board}, many);
    CHECK(test::difference(a, b, 2) < 0.03);
    CHECK(test::difference(a, b, 8) < 0.002);
}

TEST_CASE("one pixel, one sample") {
    const auto picture = test::render({test::sphere({0, 0, 0}, 1, 12, 6)}, {1, 1, 1});
    CHECK(picture.rgb.size() == 3);
}
