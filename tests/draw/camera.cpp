// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/draw/orbit_camera.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <numbers>

namespace goffer::test {
namespace {

glm::vec3 random_vector(Random& random, double size) {
    return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

draw::OrbitCamera random_camera(Random& random, float aspect) {
    draw::OrbitCamera camera(random_vector(random, 1), random_vector(random, 1));
    camera.look_at(random_vector(random, 5), static_cast<float>(uniform(random, 0.1, 10)), aspect);
    camera.orbit(static_cast<float>(uniform(random, -9, 9)), static_cast<float>(uniform(random, -2, 2)));
    camera.zoom(static_cast<float>(uniform(random, 0.5, 2)));
    return camera;
}

}  // namespace

TEST_CASE("camera: a ray through a place leads to what is seen there") {
    Random random(11);
    for (int trial = 0; trial < 200; ++trial) {
        const auto aspect = static_cast<float>(uniform(random, 0.3, 3));
        draw::OrbitCamera camera = random_camera(random, aspect);
        camera.pan({static_cast<float>(uniform(random, -1, 1)), static_cast<float>(uniform(random, -1, 1))});
        const glm::vec2 place(uniform(random, -1, 1), uniform(random, -1, 1));
        const draw::Ray ray = camera.ray(place, aspect);
        CHECK(glm::length(ray.direction) == doctest::Approx(1));
        const glm::vec3 point = ray.origin + static_cast<float>(uniform(random, 1, 30)) * ray.direction;
        CHECK(glm::distance(camera.place(point, aspect), place) < 3e-4f);
        const glm::vec3 axes = {glm::dot(camera.right(), camera.up()),
                                glm::dot(camera.up(), camera.forward()),
                                glm::dot(camera.forward(), camera.right())};
        CHECK(glm::length(axes) < 1e-5f);
    }
}

TEST_CASE("camera: what it looks at fills the picture, and no more") {
    Random random(12);
    for (int trial = 0; trial < 100; ++trial) {
        const auto aspect = static_cast<float>(uniform(random, 0.3, 3));
        const glm::vec3 center = random_vector(random, 5);
        const auto radius = static_cast<float>(uniform(random, 0.1, 10));
        draw::OrbitCamera camera = random_camera(random, aspect);
        camera.look_at(center, radius, aspect);
        CHECK(glm::length(camera.place(center, aspect)) < 3e-4f);
        float most = 0;
        for (int i = 0; i < 64; ++i) {  // the circle around the middle, at right angles to the view
            const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / 64;
            const glm::vec3 rim =
                center + radius * (std::cos(turn) * camera.right() + std::sin(turn) * camera.up());
            const glm::vec2 place = camera.place(rim, aspect);
            most = std::max({most, std::abs(place.x), std::abs(place.y)});
        }
        CHECK(most <= 1);
        CHECK(most > 0.95f);
    }
}

TEST_CASE("camera: shifted by the height of the picture, things move by as much") {
    draw::OrbitCamera camera;
    camera.look_at({1, 2, 3}, 2, 1.5f);
    camera.pan({0.5f, -0.25f});
    const glm::vec2 place = camera.place({1, 2, 3}, 1.5f);
    CHECK(place.x * 1.5f == doctest::Approx(0.5f).epsilon(1e-4));
    CHECK(place.y == doctest::Approx(-0.25f).epsilon(1e-4));
}

TEST_CASE("camera: does not turn over the poles, and stays away from the point") {
    draw::OrbitCamera camera({0, 1, 0}, {0, 0, 1});
    camera.look_at({0, 0, 0}, 1, 1);
    camera.orbit(0, 100);
    CHECK(camera.eye().z > 0);
    CHECK(camera.up().z > 0);
    camera.orbit(0, -200);
    CHECK(camera.eye().z < 0);
    CHECK(camera.up().z > 0);
    for (int i = 0; i < 200; ++i) camera.zoom(0.5f);
    CHECK(glm::length(camera.eye()) > 0.01f);
    for (int i = 0; i < 200; ++i) camera.zoom(2);
    CHECK(glm::length(camera.eye()) < 1000);
}

TEST_CASE("camera: up along the view, which tells no up, is taken all the same") {
    for (const glm::vec3& along : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        draw::OrbitCamera camera(along, along);
        camera.look_at({0, 0, 0}, 1, 1);
        CHECK(glm::length(camera.right()) == doctest::Approx(1));
        CHECK(std::isfinite(camera.view_projection(1)[0][0]));
        CHECK(glm::dot(camera.forward(), along) > 0.99f);
    }
}

}  // namespace goffer::test
