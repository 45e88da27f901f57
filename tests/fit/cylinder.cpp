// SPDX-License-Identifier: MIT
#include "refusals.hpp"
#include "support/angles.hpp"
#include "support/rounds.hpp"
#include "support/says.hpp"
#include "synthetic.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/refine.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

using namespace goffer;
using fit::Cylinder;
using test::degree;
using test::fit_to;
using test::near;
using test::Placing;
using test::Recipe;
using test::says;
using test::Solid;
using test::warped;

namespace {

/// How far a fit is from the truth: axis in radians, line in radii, the others relative.
struct CylinderMiss {
    double axis, line, length, radius;
};

CylinderMiss cylinder_miss(const Cylinder& fitted, const Recipe& recipe, const Placing& placing) {
    const glm::dvec3 axis = placing.turn[2];
    const glm::dvec3 middle = placing({0, 0, recipe.length / 2});
    const glm::dvec3 off = fitted.origin + fitted.axis * (fitted.length / 2) - middle;
    return {test::angle_between_lines(fitted.axis, axis),
            glm::length(off - fitted.axis * glm::dot(off, fitted.axis)) / placing.scale,
            std::abs(fitted.length / (placing.scale * recipe.length) - 1),
            std::abs(fitted.radius / placing.scale - 1)};
}

/// All families of the requirement; `visit` gets a recipe without noise.
void each_family(int vertices, const std::function<void(Recipe)>& visit) {
    for (const double length : {3.0, 8.0, 30.0}) {
        for (const int columns : {12, 19, 40, 128}) {
            for (const bool closed : {false, true}) {
                const Recipe even{
                    .columns = columns, .rows = vertices / columns, .length = length, .closed = closed};
                visit(even);
                Recipe recipe = even;
                recipe.dense = 10;
                visit(recipe);
                recipe.jitter = 0.45;
                recipe.dense_beta = 5;
                visit(recipe);
                recipe.dense = 1;
                visit(recipe);
            }
        }
    }
}

std::string said_of_cylinder(const Recipe& r) {
    return std::to_string(r.columns) + " x " + std::to_string(r.rows) + ", L = " + std::to_string(r.length) +
           (r.closed ? ", closed" : ", open") + ", dense " + std::to_string(r.dense) + " / " +
           std::to_string(r.dense_beta) + ", jitter " + std::to_string(r.jitter);
}

std::string cylinder_fault(const Solid& solid, std::optional<glm::dvec3> axis = std::nullopt) {
    try {
        (void)fit::fit_cylinder(solid.geometry(), axis);
    } catch (const fit::Error& error) {
        return error.what();
    }
    return {};
}

Solid some_cylinder() {
    std::mt19937 random(1);
    return test::cylinder({}, random);
}

}  // namespace

TEST_CASE("clean cylinders: axis, length and radius within 4e-6 from 12 columns up, however tessellated") {
    std::mt19937 random(31);
    for (const int vertices : {200, 1500}) {
        if (!test::all_rounds() && vertices > 200) continue;
        each_family(vertices, [&](const Recipe& recipe) {
            CAPTURE(said_of_cylinder(recipe));
            const Placing placing = test::random_placing(10 * recipe.length, random);
            const Cylinder fitted = fit_to(test::placed(test::cylinder(recipe, random), placing));
            const CylinderMiss off = cylinder_miss(fitted, recipe, placing);
            CHECK(off.axis < 5e-7);
            CHECK(off.line < 3e-6);
            CHECK(off.length < 2e-6);
            CHECK(off.radius < 4e-6);
            CHECK(fitted.residual < 5e-4);
        });
    }
}

TEST_CASE("slender cylinders, hundreds and thousands of radii long, straight and as arcs") {
    std::mt19937 random(37);
    for (const double length : {150.0, 400.0, 800.0, 2500.0}) {
        for (const double angle : {0.0, 0.4, 3.5}) {
            CAPTURE(length);
            CAPTURE(angle);
            Recipe recipe;
            recipe.columns = 16;
            recipe.rows = static_cast<int>(std::min(4 * length, 3000.0));
            recipe.length = length;
            recipe.closed = false;
            Solid solid = test::cylinder(recipe, random);
            if (angle > 0)
                solid = warped(solid, [&](glm::dvec3 p) {
                    const double phi = angle * p.z / length, far = length / angle - p.x;
                    return glm::dvec3(length / angle - far * std::cos(phi), p.y, far * std::sin(phi));
                });
            const Cylinder fitted = fit::fit_cylinder(solid.geometry());
            CHECK(std::abs(fitted.rest_angle - angle) < 1e-5);
            CHECK(std::abs(fitted.radius - 1) < 1e-4);
        }
    }
}

TEST_CASE("2 % radial noise: axis within 0.2 degrees, length within 0.25 %, radius within 0.15 %") {
    std::mt19937 random(32);
    each_family(5000, [&](Recipe recipe) {
        recipe.noise = 0.02;
        CAPTURE(said_of_cylinder(recipe));
        const Placing placing = test::random_placing(10 * recipe.length, random);
        const Cylinder fitted = fit_to(test::placed(test::cylinder(recipe, random), placing));
        const CylinderMiss off = cylinder_miss(fitted, recipe, placing);
        CHECK(off.axis < 0.2 * degree);
        CHECK(off.line < 0.003);
        CHECK(off.length < 0.0025);
        CHECK(off.radius < 0.0015);
        CHECK(fitted.residual < 0.025);
    });
}

TEST_CASE("on few vertices the axis is as exact as their noise allows") {
    // With n vertices even in beta and z, no unbiased estimate of the two tilts has an rms error below
    // sigma sqrt(48 / n) / L (Cramer-Rao: sigma sqrt(2) per section's center, z of variance L^2 / 12).
    std::mt19937 random(33);
    for (const Recipe recipe :
         {Recipe{12, 10, 4, true, 1, 1, 0, 0.02}, Recipe{32, 15, 3, false, 1, 1, 0, 0.02}}) {
        const int rounds = test::rounds(200, 40);
        double sum = 0;
        for (int i = 0; i < rounds; ++i) {
            const Placing placing = test::random_placing(recipe.length, random);
            const Cylinder fitted = fit_to(test::placed(test::cylinder(recipe, random), placing));
            sum += std::pow(cylinder_miss(fitted, recipe, placing).axis, 2);
        }
        const double binding =
            recipe.noise * std::sqrt(48.0 / (recipe.columns * (recipe.rows + 1))) / recipe.length;
        CHECK(std::sqrt(sum / rounds) < 1.15 * binding);
    }
}

TEST_CASE("a thousand lengths away, the fit is as exact as the floats") {
    std::mt19937 random(34);
    for (int i = 0; i < 20; ++i) {
        const Recipe recipe{.columns = 24, .rows = 40, .length = 10};
        const Placing placing = test::random_placing(1000 * recipe.length, random);
        const CylinderMiss off =
            cylinder_miss(fit_to(test::placed(test::cylinder(recipe, random), placing)), recipe, placing);
        CHECK(off.axis < 1.2e-5);
        CHECK(off.length < 1.6e-4);
        CHECK(off.radius < 5e-5);
    }
}

TEST_CASE("the origin is the base end, a unit right-handed frame, all z in 0..L") {
    std::mt19937 random(35);
    for (int i = 0; i < 50; ++i) {
        const Recipe recipe{.columns = 24, .rows = 20, .length = 6, .noise = 0.02};
        const Placing placing = test::random_placing(60, random);
        const Solid solid = test::placed(test::cylinder(recipe, random), placing);
        const Cylinder fitted = fit_to(solid);
        CHECK_NOTHROW(fit::check(fitted));
        CHECK(std::abs(glm::length(fitted.axis) - 1) < 1e-15);
        CHECK(std::abs(glm::length(fitted.zero) - 1) < 1e-15);
        CHECK(std::abs(glm::dot(fitted.axis, fitted.zero)) < 1e-15);
        const bool along = glm::dot(fitted.axis, placing.turn[2]) > 0;
        CHECK(glm::length(fitted.origin - placing({0, 0, along ? 0 : 6})) < 0.02 * placing.scale);
        double low = 1e300, high = -1e300;
        for (const glm::vec3& p : solid.positions) {
            const double z = glm::dot(glm::dvec3(p) - fitted.origin, fitted.axis);
            low = std::min(low, z);
            high = std::max(high, z);
        }
        CHECK(std::abs(low) < 1e-14 * fitted.length);
        CHECK(std::abs(high - fitted.length) < 1e-14 * fitted.length);
    }
}

TEST_CASE("a found axis has a positive largest component, its zero is the first most orthogonal world axis") {
    const auto placed = [](const glm::dvec3& e1, const glm::dvec3& e3) {
        return fit_to(test::placed(some_cylinder(), {.turn = {e1, glm::cross(e3, e1), e3}}));
    };
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    for (const double sign : {1.0, -1.0}) {
        const Cylinder along_x = placed(y, sign * x), along_y = placed(z, sign * y),
                       along_z = placed(x, sign * z);
        CHECK(near(along_x.axis, x));
        CHECK(near(along_x.zero, y));
        CHECK(near(along_y.axis, y));
        CHECK(near(along_y.zero, x));
        CHECK(near(along_z.axis, z));
        CHECK(near(along_z.zero, x));
        const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.3, -0.9, 0.1));
        const Cylinder free = placed(glm::normalize(glm::cross(tilted, x)), sign * tilted);
        CHECK(near(free.axis, -tilted, 1e-5));
        CHECK(near(free.zero, glm::normalize(z - tilted * tilted.z), 1e-5));
    }
}

TEST_CASE("a given axis is kept, sign and all, at any length") {
    const Solid solid = some_cylinder();
    for (const double length : {1e-310, 1e-3, 1.0, 7.0, 1e300}) {
        const Cylinder fitted = fit::fit_cylinder(solid.geometry(), glm::dvec3(0, 0, -length));
        CHECK(near(fitted.axis, {0, 0, -1}, 1e-15));
        CHECK(near(fitted.origin, {0, 0, 10}));
        CHECK(std::abs(fitted.length - 10) < 1e-12);
        CHECK(std::abs(fitted.radius - 1) < 5e-8);
    }
    const glm::dvec3 given = glm::normalize(glm::dvec3(0.02, 0.01, 1));
    CHECK(near(fit::fit_cylinder(solid.geometry(), given).axis, given, 1e-15));
    CHECK(near(fit::fit_cylinder(solid.geometry(), glm::dvec3(3, 0, 0)).axis, {1, 0, 0}, 1e-15));
}

TEST_CASE("along a given axis the line runs through the middle of the circles, not of the vertices") {
    std::mt19937 random(43);
    for (const double jitter : {0.0, 0.4}) {
        const Recipe recipe{.columns = 12, .rows = 9, .length = 5, .dense_beta = 10, .jitter = jitter};
        const Placing placing = test::random_placing(50, random);
        const Solid solid = test::placed(test::cylinder(recipe, random), placing);
        const CylinderMiss off =
            cylinder_miss(fit::fit_cylinder(solid.geometry(), placing.turn[2]), recipe, placing);
        CHECK(off.line < 3e-7);
        CHECK(off.length < 1.3e-6);
        CHECK(off.radius < 3e-7);
    }
}

TEST_CASE("half a pipe has the whole pipe's axis") {
    std::mt19937 random(44);
    const Recipe recipe{.columns = 64, .rows = 40, .length = 9, .closed = false};
    Solid half = test::cylinder(recipe, random);
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t < half.triangles.size(); t += 3) {
        const auto first = half.triangles.begin() + static_cast<std::ptrdiff_t>(t);
        if (half.positions[*first].x > 0) kept.insert(kept.end(), first, first + 3);
    }
    half.triangles = kept;
    const CylinderMiss off = cylinder_miss(fit_to(half), recipe, {});
    CHECK(off.axis < 1e-14);
    CHECK(off.line < 2e-9);
    CHECK(off.radius < 2e-8);
}

TEST_CASE("a shallow trough keeps its line in its own box, not in the far middle of its circle") {
    std::mt19937 random(46);
    const Solid trough =
        warped(test::cylinder({.columns = 32, .rows = 30, .length = 60}, random), [](glm::dvec3 p) {
            const double beta = 0.2 * std::atan2(p.y, p.x);
            return glm::dvec3(20 * std::cos(beta), 20 * std::sin(beta), p.z);
        });
    const Cylinder fitted = fit_to(trough);
    CHECK(near(fitted.axis, {0, 0, 1}, 1e-3));
    CHECK(fitted.origin.x > 20 * std::cos(0.2 * std::numbers::pi) - 0.1);
    CHECK(fitted.origin.x < 20.1);
    CHECK(fitted.radius < 12);
}

TEST_CASE("an axis without a direction is refused") {
    const Solid solid = some_cylinder();
    for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
        CHECK(says(cylinder_fault(solid, glm::dvec3(0, 0, bad)), "has no direction"));
    }
}

TEST_CASE("bodies without a long axis are refused, with what was measured and the way out") {
    std::mt19937 random(36);
    const Solid cube = test::cylinder({.columns = 4, .rows = 1, .length = std::sqrt(2.0)}, random);
    const auto sphere = [](glm::dvec3 p) {
        const double polar = std::numbers::pi * p.z / 10;
        return glm::dvec3(p.x * std::sin(polar), p.y * std::sin(polar), std::cos(polar));
    };
    const auto disc = [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 0.01 * p.z); };
    for (const Solid& solid : {cube, warped(some_cylinder(), sphere), warped(some_cylinder(), disc)}) {
        const Placing placing = test::random_placing(20, random);
        const std::string message = cylinder_fault(test::placed(solid, placing));
        CHECK(says(message, "no long axis"));
        CHECK(says(message, "as wide as it is long"));
        CHECK(says(message, "give an axis"));
        CHECK_THROWS_AS((void)fit_to(test::placed(solid, placing)), fit::AxisError);
        CHECK(cylinder_fault(test::placed(solid, placing), placing.turn[2]) == "");
    }
}

TEST_CASE("a given axis through a sphere finds its sections' mean area") {
    std::mt19937 random(37);
    const Solid ball =
        warped(test::cylinder({.columns = 64, .rows = 100, .length = 10, .closed = false}, random),
               [](glm::dvec3 p) {
                   const double polar = std::numbers::pi * p.z / 10;
                   return glm::dvec3(p.x * std::sin(polar), p.y * std::sin(polar), std::cos(polar));
               });
    const Cylinder fitted = fit::fit_cylinder(ball.geometry(), glm::dvec3(0, 0, 1));
    CHECK(std::abs(fitted.length - 2) < 1e-7);
    CHECK(std::abs(fitted.radius - std::sqrt(2.0 / 3)) < 1.4e-4);
}

TEST_CASE("the result does not depend on duplicated or unused vertices, winding or order") {
    std::mt19937 random(38);
    const Recipe recipe{.columns = 24, .rows = 30, .length = 7, .jitter = 0.3, .noise = 0.02};
    const Solid solid = test::placed(test::cylinder(recipe, random), test::random_placing(5, random));
    const Cylinder expected = fit_to(solid);
    const Cylinder fitted = fit_to(test::scrambled(solid));
    CHECK(near(fitted.axis, expected.axis, 1e-9));
    CHECK(near(fitted.origin, expected.origin, 1e-9 * expected.length));
    CHECK(std::abs(fitted.length / expected.length - 1) < 1e-12);
    CHECK(std::abs(fitted.radius / expected.radius - 1) < 1e-12);
    CHECK(std::abs(fitted.residual / expected.residual - 1) < 1e-10);
}

TEST_CASE("a body that is no cylinder follows rotation, translation and scale, and its tessellation little") {
    const auto bowling_pin = [](glm::dvec3 p) {
        const double waist = 1 + 0.4 * std::sin(0.7 * p.z), bow = 0.3 * std::sin(0.3 * p.z);
        return glm::dvec3(p.x * waist + (p.x > 0 ? 0.6 * p.x : 0) + bow, 0.7 * p.y * waist, p.z);
    };
    std::mt19937 random(39);
    const Recipe fine{.columns = 128, .rows = 256};
    const Cylinder expected = fit_to(warped(test::cylinder(fine, random), bowling_pin));
    CHECK(expected.residual > 0.2);
    for (const double dense : {1.0, 10.0}) {
        for (const double dense_beta : {1.0, 4.0}) {
            const Recipe recipe{.columns = 64, .rows = 160, .dense = dense, .dense_beta = dense_beta};
            const Placing placing = test::random_placing(30, random);
            const Solid solid = test::placed(warped(test::cylinder(recipe, random), bowling_pin), placing);
            const Cylinder fitted = fit_to(solid);
            CHECK(test::angle_between_lines(fitted.axis, placing.turn * expected.axis) < 4e-5);
            CHECK(std::abs(fitted.length / (placing.scale * expected.length) - 1) < 1e-5);
            CHECK(std::abs(fitted.radius / (placing.scale * expected.radius) - 1) < 1.3e-3);
            CHECK(std::abs(fitted.residual / expected.residual - 1) < 5e-3);
        }
    }
}

TEST_CASE("a prism's radius is that of its corners, an elliptic section's that of its area") {
    std::mt19937 random(40);
    const Solid prism = test::cylinder({.columns = 5, .rows = 3, .length = 9}, random);
    CHECK(std::abs(fit_to(prism).radius - 1) < 3e-8);
    for (const int columns : {16, 32, 128}) {
        const Solid flat = warped(test::cylinder({.columns = columns, .rows = 64}, random),
                                  [](glm::dvec3 p) { return glm::dvec3(2 * p.x, 0.5 * p.y, 2 * p.z); });
        CHECK(std::abs(fit_to(flat).radius - 1) < (columns < 100 ? 0.05 : 0.002));
    }
}

TEST_CASE("a frustum's radius is exact from one row up, for it is linear") {
    std::mt19937 random(45);
    for (const int rows : {1, 2, 7}) {
        const Recipe recipe{.columns = 128, .rows = rows, .length = 6};
        const Solid frustum = warped(test::cylinder(recipe, random), [](glm::dvec3 p) {
            const double rho = 1 - p.z / 12;
            return glm::dvec3(rho * p.x, rho * p.y, p.z);
        });
        CHECK(std::abs(fit_to(frustum).radius - std::sqrt(7.0 / 12)) < 1e-8);
    }
}

TEST_CASE("the residual is the relief over the radius") {
    std::mt19937 random(41);
    const Solid fluted =
        warped(test::cylinder({.columns = 192, .rows = 64, .length = 8}, random), [](glm::dvec3 p) {
            const double rho = 1 + 0.05 * std::sin(6 * std::atan2(p.y, p.x));
            return glm::dvec3(rho * p.x, rho * p.y, p.z);
        });
    CHECK(std::abs(fit_to(fluted).residual - 0.05 / std::sqrt(2.0)) < 3e-4);
}

TEST_CASE("bodies that floats cannot carry are refused") {
    const Solid solid = some_cylinder();
    CHECK(
        says(cylinder_fault(warped(solid, [](glm::dvec3 p) { return p * 1e-40; })), "too small for floats"));
    CHECK(says(cylinder_fault(warped(solid, [](glm::dvec3 p) { return p * glm::dvec3(1e-12, 1e-12, 1); })),
               "on one line"));
    CHECK(says(cylinder_fault(warped(solid, [](glm::dvec3 p) { return p + 1e9; })), "in one point"));
    CHECK(cylinder_fault(warped(solid, [](glm::dvec3 p) { return p * 1e30; })) == "");
    CHECK(cylinder_fault(warped(solid, [](glm::dvec3 p) { return p * 1e-30; })) == "");
}

TEST_CASE("triangles without area, and faults of the mesh, are refused") {
    Solid solid = some_cylinder();
    for (std::size_t t = 0; t < solid.triangles.size(); t += 3) solid.triangles[t + 1] = solid.triangles[t];
    CHECK(says(cylinder_fault(solid), "without area"));
    CHECK(says(cylinder_fault(solid, glm::dvec3(0, 0, 1)), "without area"));
    solid.triangles[5] = 1'000'000;
    CHECK(says(cylinder_fault(solid), "triangle 1 uses vertex 1000000"));
}

TEST_CASE("plates across the given axis have no surface around it") {
    const Solid plates{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}},
                       {0, 1, 2, 3, 4, 5}};
    CHECK(says(cylinder_fault(plates, glm::dvec3(0, 0, 1)), "no surface around the axis"));
    CHECK_THROWS_AS((void)fit::fit_cylinder(plates.geometry(), glm::dvec3(0, 0, 1)), fit::AxisError);
}

TEST_CASE("hostile but valid meshes end in an error or in finite numbers") {
    const std::vector<float> numbers{0.0f,  1.0f,  -1.0f,  1.0000001f, 1e-45f, -1e-38f, 1e-20f,
                                     1e-6f, 3e38f, -3e38f, 1e30f,      1e4f,   -0.0f,   0.5f};
    std::mt19937 random(42);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const int rounds = test::rounds(4000, 80);
    int fitted = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::size_t kinds = round % 2 == 0 ? numbers.size() : 4;
        const auto number = [&] { return round % 5 == 0 ? uniform(random) : numbers[random() % kinds]; };
        Solid solid;
        for (int i = 0; i < 8; ++i) solid.positions.push_back(glm::vec3{number(), number(), number()});
        for (int i = 0; i < 24; ++i) solid.triangles.push_back(static_cast<std::uint32_t>(random() % 8));
        std::optional<glm::dvec3> axis;
        if (round % 3 == 0) axis = glm::dvec3{number(), number(), number()};
        try {
            const auto rest = round % 4 == 1 ? fit::RestPose::chain : fit::RestPose::automatic;
            const Cylinder cylinder = fit::fit_cylinder(solid.geometry(), axis, rest);
            REQUIRE_NOTHROW(fit::check(cylinder));
            REQUIRE(fit::folds_capacity(solid.geometry(), cylinder) <= fit::Stretch::max_folds);
            ++fitted;
        } catch (const fit::Error& error) {
            REQUIRE(std::string(error.what()).find("nan") == std::string::npos);
        }
    }
    CHECK(fitted > rounds / 2);
}

TEST_CASE("check of a cylinder names the field at fault") {
    const auto said_of = [](auto&& spoil) {
        Cylinder cylinder;
        spoil(cylinder);
        return test::error_of([&] { fit::check(cylinder); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(said_of([](Cylinder&) {}) == "");
    CHECK(said_of([](Cylinder& c) { c.axis *= 1.0009; }) == "");
    CHECK(says(said_of([&](Cylinder& c) { c.origin.y = nan; }), "origin"));
    CHECK(says(said_of([&](Cylinder& c) { c.axis.z = HUGE_VAL; }), "axis"));
    CHECK(says(said_of([&](Cylinder& c) { c.zero.x = nan; }), "zero"));
    CHECK(says(said_of([&](Cylinder& c) { c.axis *= 1.01; }), "axis"));
    CHECK(says(said_of([&](Cylinder& c) { c.zero *= 0.5; }), "zero"));
    CHECK(says(said_of([&](Cylinder& c) { c.zero = {0, 0, 1}; }), "not orthogonal"));
    for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
        CHECK(says(said_of([&](Cylinder& c) { c.length = bad; }), "length"));
        CHECK(says(said_of([&](Cylinder& c) { c.radius = bad; }), "radius"));
    }
    for (const double bad : {1e-41, 1e41, 1e308}) {
        CHECK(says(said_of([&](Cylinder& c) { c.length = c.radius = bad; }), "beyond what a mesh"));
        CHECK(says(said_of([&](Cylinder& c) { c.radius = bad; }), "beyond what a mesh"));
        CHECK(says(said_of([&](Cylinder& c) { c.radii = {bad, bad}; }), "beyond what a mesh"));
    }
    CHECK(says(said_of([&](Cylinder& c) { c.radii = {1e-5, 0.2 - 1e-5}; }), "a thousandth of it"));
    CHECK(said_of([&](Cylinder& c) { c.radii = {1.01e-4, 0.2 - 1.01e-4}; }) == "");
    CHECK(says(said_of([&](Cylinder& c) { c.origin.z = -1e41; }), "beyond what a mesh"));
    CHECK(says(said_of([&](Cylinder& c) { c.rest_angle = nan; }), "rest_angle"));
    for (const double bad : {-1e-9, 5.0, 6.3, HUGE_VAL})  // length / (2 radius) is 5
        CHECK(says(said_of([&](Cylinder& c) { c.rest_angle = bad; }), "rest_angle"));
    CHECK(said_of([](Cylinder& c) { c.rest_angle = 4.9; }) == "");
    CHECK(says(said_of([](Cylinder& c) { c.rest_angle = 6.3, c.length = 10; }), "rest_angle"));
    CHECK(says(said_of([&](Cylinder& c) { c.rest_direction = nan; }), "rest_direction"));
    CHECK(says(said_of([&](Cylinder& c) { c.residual = nan; }), "residual"));
}
