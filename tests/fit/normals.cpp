// SPDX-License-Identifier: MIT
#include "refined.hpp"
#include "synthetic.hpp"

#include <goffer/fit/normals.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace goffer;
using test::near;
using test::Solid;

namespace {

std::vector<glm::vec3> normals_of(const Solid& solid) {
    return fit::make_normals(solid.positions, solid.triangles);
}

const std::vector<glm::vec3> cube_corners{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                          {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
const std::vector<std::uint32_t> cube_triangles{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

}  // namespace

TEST_CASE("corners of a cube point along its diagonals, however its sides are cut into triangles") {
    const std::vector<glm::vec3> normals = fit::make_normals(cube_corners, cube_triangles);
    for (std::size_t i = 0; i < 8; ++i) CHECK(near(normals[i], glm::normalize(glm::dvec3(cube_corners[i]))));
}

TEST_CASE("duplicated vertices agree, also at -0 and 0") {
    Solid loose;
    for (const std::uint32_t i : cube_triangles) {
        loose.triangles.push_back(static_cast<std::uint32_t>(loose.positions.size()));
        glm::vec3 p = cube_corners[i] + 1.0f;
        if (p.x == 0 && loose.positions.size() % 2 == 1) p.x = -0.0f;
        loose.positions.push_back(p);
    }
    const std::vector<glm::vec3> normals = normals_of(loose);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        CHECK(near(normals[i], glm::normalize(glm::dvec3(loose.positions[i] - 1.0f))));
    }
}

TEST_CASE("normals of a cylinder's skin are its radii, of unit length at any scale") {
    std::mt19937 random(21);
    for (const double scale : {1e-30, 1e-4, 1.0, 1e4, 1e30}) {
        const Solid solid = test::placed(test::cylinder({.closed = false}, random), {.scale = scale});
        const std::vector<glm::vec3> normals = normals_of(solid);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::dvec3 p = glm::dvec3(solid.positions[i]) / scale;
            REQUIRE(near(normals[i], {p.x, p.y, 0}, 1e-5));
            REQUIRE(std::abs(glm::length(glm::dvec3(normals[i])) - 1) < 1e-7);
        }
    }
}

TEST_CASE("refined normals shade a tube of few sides as it was shaded, and leave its rims sharp") {
    std::mt19937 random(23);
    for (const int sides : {7, 12, 40}) {
        const Solid solid = test::cylinder({.columns = sides, .rows = 3, .dense = 2}, random);
        const fit::Refinement refinement = fit::refine(solid.geometry(), test::upright(), 12);
        const Solid after = test::applied(solid, refinement);
        const std::vector<glm::vec3> normals =
            fit::make_refined_normals(solid.positions, solid.triangles, refinement);
        REQUIRE(normals.size() == after.positions.size());
        REQUIRE(after.positions.size() > 5 * solid.positions.size());
        double worst = 1, flat = 1;
        const std::vector<glm::vec3> of_pieces = normals_of(after);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const glm::dvec3 p = after.positions[i], n = normals[i];
            REQUIRE(std::abs(glm::length(n) - 1) < 1e-6);
            const double rho = glm::length(glm::dvec2(p));
            if (p.z > 0.01 && p.z < 9.99) {
                worst = std::min(worst, glm::dot(n, glm::dvec3(glm::dvec2(p) / rho, 0)));
                flat = std::min(flat, glm::dot(glm::dvec3(of_pieces[i]), glm::dvec3(glm::dvec2(p) / rho, 0)));
            } else if (rho < 0.5) {
                CHECK(near(n, {0, 0, p.z < 5 ? -1 : 1}));
            }
        }
        const double half = std::numbers::pi / sides;  // of what a side spans
        CHECK(std::acos(worst) < 0.35 * half);         // as far as a chord is from its arc
        CHECK(std::acos(flat) > 0.6 * half);
    }
}

TEST_CASE("refined normals: vertices at one place agree, and hostile numbers give unit normals") {
    std::mt19937 random(24);
    const Solid closed = test::cylinder({.columns = 9, .rows = 2}, random);
    Solid soup;
    for (const std::uint32_t i : closed.triangles) {
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(closed.positions[i]);
    }
    const fit::Refinement one = fit::refine(closed.geometry(), test::upright(), 12);
    const fit::Refinement loose = fit::refine(soup.geometry(), test::upright(), 12);
    const auto of_closed = fit::make_refined_normals(closed.positions, closed.triangles, one);
    const auto of_soup = fit::make_refined_normals(soup.positions, soup.triangles, loose);
    REQUIRE(one.triangles.size() == loose.triangles.size());
    for (std::size_t c = 0; c < one.triangles.size(); ++c)
        REQUIRE(near(of_closed[one.triangles[c]], glm::dvec3(of_soup[loose.triangles[c]]), 1e-5));
    for (const float size : {0.0f, 1e-45f, 1e-38f, 1e30f, 3e38f}) {
        Solid odd = closed;
        for (glm::vec3& p : odd.positions)
            if (random() % 3 == 0) p *= size;
        for (const glm::vec3& n : fit::make_refined_normals(odd.positions, odd.triangles, one))
            REQUIRE(std::abs(glm::length(glm::dvec3(n)) - 1) < 1e-6);
    }
}

TEST_CASE("two sheets back to back keep a side each") {
    const Solid sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 3, 5, 4}};
    const std::vector<glm::vec3> normals = normals_of(sheet);
    for (std::size_t i = 0; i < 6; ++i) CHECK(near(normals[i], {0, 0, i < 3 ? 1 : -1}));
}

TEST_CASE("vertices without a direction get (0, 0, 1)") {
    const Solid odd{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {0, 1, 2, 0, 0, 1}};
    for (const glm::vec3& n : normals_of(odd)) CHECK(n == glm::vec3(0, 0, 1));
    CHECK(fit::make_normals({}, {}).empty());
}

TEST_CASE("hostile numbers give unit normals") {
    const std::vector<float> numbers{0.0f, 1.0f, -1.0f, 1e-45f, 1e-38f, 1e30f, -3e38f};
    std::mt19937 random(22);
    std::uniform_int_distribution<std::size_t> pick(0, numbers.size() - 1);
    for (int round = 0; round < 500; ++round) {
        Solid solid;
        for (int i = 0; i < 10; ++i) {
            solid.positions.push_back(
                glm::vec3{numbers[pick(random)], numbers[pick(random)], numbers[pick(random)]});
        }
        for (int i = 0; i < 30; ++i) solid.triangles.push_back(static_cast<std::uint32_t>(random() % 10));
        for (const glm::vec3& n : normals_of(solid)) {
            REQUIRE(std::abs(glm::length(glm::dvec3(n)) - 1) < 1e-7);
        }
    }
}
