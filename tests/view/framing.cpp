// SPDX-License-Identifier: MIT
#include "shapes.hpp"

#include <doctest/doctest.h>

using namespace goffer;

namespace {

// Where a model is: what the red channel tells from the gray background.
struct Silhouette {
    double area = 0, x = 0, y = 0;  // pixels; the center is that of the picture's coordinates
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Silhouette silhouette(const view::Picture& picture, int from = 0, int to = 1 << 20) {
    Silhouette s;
    for (int y = 0; y < picture.height; ++y)
        for (int x = from; x < std::min(to, picture.width); ++x) {
            const glm::ivec3 c = test::pixel(picture, x, y);
            if (c.r - c.b < 40) continue;
            s.area += 1, s.x += x + 0.5, s.y += y + 0.5;
            s.left = std::min(s.left, x), s.right = std::max(s.right, x + 1);
            s.top = std::min(s.top, y), s.bottom = std::max(s.bottom, y + 1);
        }
    s.x /= s.area, s.y /= s.area;
    return s;
}

test::Shape red_sphere(const glm::vec3& center, float radius) {
    test::Shape s = test::sphere(center, radius);
    s.color = {0.9f, 0.1f, 0.05f, 1};
    return s;
}

}  // namespace

TEST_CASE("a sphere is a disc in the middle, as large as the picture allows") {
    for (const auto& [width, height] : {std::pair{640, 480}, std::pair{320, 480}}) {
        const auto s = silhouette(test::render({red_sphere({3, -7, 2}, 0.5f)}, {width, height, 4}));
        const double radius = (s.right - s.left + s.bottom - s.top) / 4.0;
        const double half = std::min(width, height) / 2.0;
        CHECK(radius > 0.85 * half);
        CHECK(radius < 0.97 * half);
        CHECK(s.area == doctest::Approx(std::numbers::pi * radius * radius).epsilon(0.006));
        CHECK(s.x == doctest::Approx(width / 2.0).epsilon(0.002));
        CHECK(s.y == doctest::Approx(height / 2.0).epsilon(0.002));
    }
}

TEST_CASE("two spheres side by side are the ellipses of the perspective") {
    constexpr double c = 2, r = 1;
    const view::Settings settings{960, 480, 4};
    const view::Camera camera{{0, 1, 0}, {0, 0, 1}, 1.2f};
    const auto picture =
        test::render({red_sphere({-c, 0, 0}, r), red_sphere({c, 0, 0}, r)}, settings, camera);
    const auto left = silhouette(picture, 0, 480), right = silhouette(picture, 480);

    // The outer edge lies at tan(theta + delta), which gives the distance of the camera, and this all the
    // rest.
    const double focal = 240 / std::tan(0.6);  // pixels
    const double outer = std::atan((right.right - left.left) / 2.0 / focal);
    const auto edge = [&](double z) { return std::atan2(c, z) + std::asin(r / std::hypot(c, z)); };
    double near = 1.1, far = 50;
    for (int i = 0; i < 60; ++i) (edge((near + far) / 2) > outer ? near : far) = (near + far) / 2;
    const double inner = std::atan2(c, near) - std::asin(r / std::hypot(c, near));
    const double area = std::numbers::pi * r * r * focal * focal * std::sqrt(c * c + near * near - r * r) /
                        std::pow(near * near - r * r, 1.5);

    CHECK(right.left - 480 == doctest::Approx(focal * std::tan(inner)).epsilon(0.02));
    CHECK(480 - left.right == doctest::Approx(focal * std::tan(inner)).epsilon(0.02));
    CHECK(right.area == doctest::Approx(area).epsilon(0.01));
    CHECK(left.area == doctest::Approx(area).epsilon(0.01));
    CHECK((right.right - 480) / 480.0 > 0.9);
}

TEST_CASE("all vertices are in the picture, whatever the direction and the field of view") {
    const test::Shape ball = red_sphere({1, 2, 3}, 1), small = red_sphere({4, 2.5f, 2}, 0.3f);
    for (const float fov : {0.05f, 0.5f, 2.0f})
        for (const glm::vec3 toward :
             {glm::vec3(-0.4f, -1, -0.35f), glm::vec3(0, 0, -1), glm::vec3(-1e-20f, 0, 0)}) {
            const auto s = silhouette(test::render({ball, small}, {200, 150, 1}, {toward, {0, 0, 1}, fov}));
            CHECK(s.left > 0);
            CHECK(s.right < 200);
            CHECK(s.top > 0);
            CHECK(s.bottom < 150);
            CHECK((s.right - s.left > 170 || s.bottom - s.top > 127));
        }
}

TEST_CASE("vertices that no triangle uses do not matter") {
    test::Shape ball = test::sphere({0, 0, 0}, 1, 24, 12);
    const auto plain = test::render({ball}, {80, 60, 2});
    ball.positions.emplace_back(100, 0, std::nanf(""));
    ball.normals.emplace_back(0, 0, 1);
    CHECK(test::render({ball}, {80, 60, 2}).rgb == plain.rgb);
}

TEST_CASE("pictures of a motion stay in place with the points that decide") {
    const test::Shape near = red_sphere({0, 0, 0}, 0.5f), far = red_sphere({3, 1, 2}, 0.5f);
    const auto look = [&](const test::Shape& shape, std::span<const glm::vec3> also) {
        const std::vector<view::Model> models{shape.model()};
        view::Camera camera;
        camera.also_seen = also;
        return view::render(models, camera, {320, 240, 4});
    };
    view::Camera camera;
    std::vector<glm::vec3> seen = view::deciding_points(camera, near.positions, {320, 240, 4});
    const std::vector<glm::vec3> more = view::deciding_points(camera, far.positions, {320, 240, 4});
    CHECK(seen.size() + more.size() < 30);
    seen.insert(seen.end(), more.begin(), more.end());
    const view::Picture both = test::render({near, far}, {320, 240, 4});
    const Silhouette a = silhouette(look(near, seen)), b = silhouette(look(far, seen)),
                     all = silhouette(both);
    CHECK(std::min(a.left, b.left) == all.left);
    CHECK(std::max(a.right, b.right) == all.right);
    CHECK(std::min(a.top, b.top) == all.top);
    CHECK(std::max(a.bottom, b.bottom) == all.bottom);
    CHECK(silhouette(look(near, {})).area > 2 * a.area);
}
