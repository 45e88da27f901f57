// SPDX-License-Identifier: MIT
#include "shapes.hpp"
#include "support/says.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace goffer;
using test::says;

namespace {

const view::Settings tiny{16, 12, 1};

std::string refusal(const std::vector<view::Model>& models, const view::Camera& camera = {},
                    const view::Settings& settings = tiny) {
    try {
        static_cast<void>(view::render(models, camera, settings));
    } catch (const view::Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("nothing to see") {
    test::Shape board = test::square({1, 2, 3}, 1);
    CHECK(says(refusal({}), "no triangles"));
    view::Model points = board.model();
    points.triangles = {};
    CHECK(says(refusal({points, points}), "no triangles"));
    board.positions.assign(4, {1, 2, 3});
    CHECK(says(refusal({board.model()}), "in one point"));
}

TEST_CASE("a broken model is named, and where it is broken") {
    const test::Shape good = test::square({0, 0, 0}, 1);
    test::Shape bad = good;
    SUBCASE("index") {
        bad.triangles[4] = 4;
        CHECK(
            says(refusal({good.model(), bad.model()}), "model 1: a triangle uses vertex 4, but there are 4"));
    }
    SUBCASE("nan") {
        bad.positions[2].y = std::nanf("");
        CHECK(says(refusal({good.model(), bad.model()}), "model 1: vertex 2 is not finite"));
    }
    SUBCASE("half a triangle") {
        bad.triangles.pop_back();
        CHECK(says(refusal({good.model(), bad.model()}), "model 1: 5 indices"));
    }
    SUBCASE("normals") {
        bad.normals.assign(3, {0, 0, 1});
        CHECK(says(refusal({good.model(), bad.model()}), "model 1: 3 normals for 4 vertices"));
    }
    SUBCASE("colors") {
        const std::vector<glm::vec4> colors(5, glm::vec4(1));
        view::Model model = bad.model();
        model.colors = colors;
        CHECK(says(refusal({good.model(), model}), "model 1: 5 colors for 4 vertices"));
    }
}

TEST_CASE("cameras and sizes that make no picture") {
    const test::Shape board = test::square({0, 0, 0}, 1);
    CHECK(says(refusal({board.model()}, {{0, 0, 0}}), "toward"));
    CHECK(says(refusal({board.model()}, {{0, std::nanf(""), 0}}), "toward"));
    CHECK(says(refusal({board.model()}, {{0, 0, -1}, {0, 0, 0}}), "up"));
    CHECK(says(refusal({board.model()}, {{0, 0, -1}, {0, 1, 0}, 0}), "field of view"));
    CHECK(says(refusal({board.model()}, {}, {0, 10, 1}), "0 x 10"));
    CHECK(says(refusal({board.model()}, {}, {10, 1 << 20, 1}), "10 x 1048576"));
    CHECK(says(refusal({board.model()}, {}, {10, 10, 0}), "0 samples"));
}

TEST_CASE("what is odd but can be seen is rendered") {
    const test::Shape board = test::square({0, 0, 0}, 1);
    CHECK(refusal({board.model()}, {{0, 0, -1}, {0, 0, 1}}) == "");  // up along the view
    CHECK(refusal({board.model()}, {{1, 0, 0}, {0, 0, 1}}) == "");   // edge-on
    test::Shape huge = board;
    for (glm::vec3& p : huge.positions) p *= 3e38f;
    CHECK(refusal({huge.model()}) == "");
    test::Shape line = board;
    for (glm::vec3& p : line.positions) p.y = 0;
    CHECK(refusal({line.model()}) == "");
}
