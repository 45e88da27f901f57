// SPDX-License-Identifier: MIT
#include "refined.hpp"
#include "support/angles.hpp"
#include "support/rounds.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>

using namespace goffer;
using fit::Cylinder;
using test::degree;
using test::fit_to;
using test::Placing;
using test::Recipe;
using test::Solid;
using test::warped;

namespace {

/// A recipe's cylinder, bent by the closed form.
Solid bent_cylinder(const Recipe& recipe, const paper::Pose& rest, std::mt19937& random) {
    const paper::ClosedForm map({.length = recipe.length, .radius = 1}, rest);
    return warped(test::cylinder(recipe, random),
                  [&](glm::dvec3 p) { return map.position(paper::to_cylindrical(p)); });
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

/// How far a fit is from the truth: angles in radians, the line in radii, the others relative.
struct ArcMiss {
    double angle, direction, axis, origin, length, radius;
};

/// The fit may have exchanged base and tip. Directions are therefore compared in space: as the direction that
/// the body bends toward at the base that was found.
ArcMiss arc_miss(const Cylinder& fitted, const Recipe& recipe, const paper::Pose& rest,
                 const Placing& placing) {
    const paper::ClosedForm map({.length = recipe.length, .radius = 1}, rest);
    const glm::dvec3 theta(std::cos(rest.direction), std::sin(rest.direction), 0), up(0, 0, 1);
    const glm::dvec3 tip_axis = -(std::cos(rest.angle) * up + std::sin(rest.angle) * theta);
    const glm::dvec3 tip_bow = std::cos(rest.angle) * theta - std::sin(rest.angle) * up;
    const glm::dvec3 tip = placing(map.center(recipe.length));
    const bool turned = glm::length(fitted.origin - tip) < glm::length(fitted.origin - placing({0, 0, 0}));
    const glm::dvec3 second = glm::cross(fitted.axis, fitted.zero);
    const glm::dvec3 bow =
        std::cos(fitted.rest_direction) * fitted.zero + std::sin(fitted.rest_direction) * second;
    const glm::dvec3 true_bow = placing.turn * (turned ? tip_bow : theta);
    const glm::dvec3 true_axis = placing.turn * (turned ? tip_axis : up);
    const auto between = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    // The axis may be off within the plane of the arc, too; that is no fault of the direction.
    const glm::dvec3 normal = glm::normalize(glm::cross(true_axis, true_bow));
    const double off = std::asin(std::clamp(glm::dot(bow, normal), -1.0, 1.0));
    return {std::abs(fitted.rest_angle - rest.angle),
            glm::dot(bow, true_bow) > 0 ? std::abs(off) : std::numbers::pi,
            between(fitted.axis, true_axis),
            glm::length(fitted.origin - (turned ? tip : placing({0, 0, 0}))) / placing.scale,
            std::abs(fitted.length / (placing.scale * recipe.length) - 1),
            std::abs(fitted.radius / placing.scale - 1)};
}

/// All families of the requirement; `visit` gets a recipe of 5000 vertices without noise, and an angle.
void each_arc(const std::function<void(Recipe, double)>& visit) {
    for (const double angle : {10.0, 35.0, 60.0, 90.0, 120.0, 150.0}) {
        for (const double length : {6.0, 9.0, 15.0, 30.0}) {
            if (length < 2.2 * angle * degree) continue;
            const bool common = angle == 60 && length == 15, stout = angle == 150 && length == 6;
            if (!test::all_rounds() && !common && !stout) continue;
            for (const int columns : {12, 40}) {
                for (const bool closed : {false, true}) {
                    Recipe recipe{
                        .columns = columns, .rows = 5000 / columns, .length = length, .closed = closed};
                    visit(recipe, angle * degree);
                    recipe.jitter = 0.4;
                    recipe.dense_beta = 3;
                    recipe.dense = 5;
                    visit(recipe, angle * degree);
                }
            }
        }
    }
}

std::string said_of_arc(const Recipe& r, const paper::Pose& rest) {
    return std::to_string(rest.angle / degree) + " degrees to " + std::to_string(rest.direction / degree) +
           ", " + std::to_string(r.columns) + " x " + std::to_string(r.rows) +
           ", L = " + std::to_string(r.length) + (r.closed ? ", closed" : ", open") + ", dense " +
           std::to_string(r.dense);
}

/// rms of (rho - r) / r over the vertices, by the inverse that bind uses, and the range of z / L.
struct About {
    double residual, low, high;
};

About about(const Cylinder& c, const Solid& solid) {
    const glm::dmat3 axes(c.zero, glm::cross(c.axis, c.zero), c.axis);
    About result{0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::vec3& p : solid.positions) {
        const paper::Cylindrical v =
            paper::to_cylindrical(glm::transpose(axes) * (glm::dvec3(p) - c.origin), c.length, c.radius,
                                  {c.rest_angle, c.rest_direction});
        result.residual += std::pow(v.rho / c.radius - 1, 2) / static_cast<double>(solid.positions.size());
        result.low = std::min(result.low, v.z / c.length);
        result.high = std::max(result.high, v.z / c.length);
    }
    result.residual = std::sqrt(result.residual);
    return result;
}

}  // namespace

TEST_CASE("arcs: clean ones are found exactly, however tessellated, and the inverse unbends them") {
    std::mt19937 random(61);
    std::uniform_real_distribution<double> direction(-std::numbers::pi, std::numbers::pi);
    each_arc([&](const Recipe& recipe, double angle) {
        const paper::Pose rest{angle, direction(random)};
        CAPTURE(said_of_arc(recipe, rest));
        const Placing placing = test::random_placing(10 * recipe.length, random);
        const Solid solid = test::placed(bent_cylinder(recipe, rest, random), placing);
        const Cylinder fitted = fit_to(solid);
        CHECK_NOTHROW(fit::check(fitted));
        const ArcMiss off = arc_miss(fitted, recipe, rest, placing);
        CHECK(off.angle < 2e-5);
        CHECK(off.direction < 3e-6);
        CHECK(off.axis < 1.2e-5);
        CHECK(off.origin < 2.5e-5);
        CHECK(off.length < 7e-6);
        CHECK(off.radius < 5e-7);
        const About unbent = about(fitted, solid);
        CHECK(unbent.low > -1e-6);
        CHECK(unbent.high < 1 + 1e-6);
        if (!recipe.closed) CHECK(unbent.residual < 1.3e-5);
    });
}

TEST_CASE("arcs: 1 % noise: angle within 1 degree, direction within 0.6, length within 0.5 %, radius 0.1 %") {
    std::mt19937 random(62);
    std::uniform_real_distribution<double> direction(-std::numbers::pi, std::numbers::pi);
    ArcMiss worst{};
    each_arc([&](Recipe recipe, double angle) {
        recipe.noise = 0.01;
        const paper::Pose rest{angle, direction(random)};
        CAPTURE(said_of_arc(recipe, rest));
        const Placing placing = test::random_placing(10 * recipe.length, random);
        const ArcMiss off = arc_miss(fit_to(test::placed(bent_cylinder(recipe, rest, random), placing)),
                                     recipe, rest, placing);
        CHECK(off.angle < 1 * degree);
        CHECK(off.direction < 0.6 * degree);
        CHECK(off.length < 0.005);
        CHECK(off.radius < 0.001);
        test::take_worst(worst.angle, off.angle);
        test::take_worst(worst.direction, off.direction);
        test::take_worst(worst.length, off.length);
        test::take_worst(worst.radius, off.radius);
    });
    MESSAGE("worst: angle ", worst.angle / degree, " degrees, direction ", worst.direction / degree,
            " degrees, length ", 100 * worst.length, " %, radius ", 100 * worst.radius, " %");
}

TEST_CASE("arcs: a straight body stays straight, to the bit what RestPose::straight says") {
    std::mt19937 random(63);
    const auto bumpy = [](glm::dvec3 p) {
        const double rho = 1 + 0.08 * std::sin(3 * std::atan2(p.y, p.x) + 2 * p.z) * std::sin(1.3 * p.z);
        return glm::dvec3(rho * p.x, rho * p.y, p.z);
    };
    const auto cone = [](glm::dvec3 p) { return glm::dvec3((1 - 0.07 * p.z) * glm::dvec2(p), p.z); };
    const auto capsule = [](glm::dvec3 p) {
        const double end = std::max({1 - p.z, p.z - 9, 0.0});
        return glm::dvec3(std::sqrt(1 - end * end) * glm::dvec2(p), p.z);
    };
    const auto bottle = [](glm::dvec3 p) {
        return glm::dvec3((p.z < 6 ? 1 : p.z < 7 ? 1 - 0.7 * (p.z - 6) : 0.3) * glm::dvec2(p), p.z);
    };
    const auto flat = [](glm::dvec3 p) { return glm::dvec3(1.5 * p.x, 0.6 * p.y, p.z); };
    const auto plain = [](glm::dvec3 p) { return p; };
    for (const double noise : {0.0, 0.02, 0.05}) {
        for (const auto& shape :
             {std::function<glm::dvec3(glm::dvec3)>(plain), {bumpy}, {cone}, {capsule}, {bottle}, {flat}}) {
            for (const bool closed : {false, true}) {
                const Recipe recipe{.columns = 24, .rows = 60, .closed = closed, .noise = noise};
                const Placing placing = test::random_placing(30, random);
                const Solid solid = test::placed(warped(test::cylinder(recipe, random), shape), placing);
                const Cylinder fitted = fit_to(solid);
                const Cylinder straight =
                    fit::fit_cylinder(solid.geometry(), std::nullopt, fit::RestPose::straight);
                CHECK(fitted.rest_angle == 0);
                CHECK(fitted.rest_direction == 0);
                CHECK(fitted.axis == straight.axis);
                CHECK(fitted.origin == straight.origin);
                CHECK(fitted.length == straight.length);
                CHECK(fitted.radius == straight.radius);
                CHECK(fitted.residual == straight.residual);
            }
        }
    }
}

TEST_CASE("arcs: what sags by less than a twentieth of its radius is straight") {
    std::mt19937 random(64);
    for (const double sag : {0.02, 0.1}) {
        const Recipe recipe{.columns = 24, .rows = 60, .closed = false};
        const Solid solid = bent_cylinder(recipe, {8 * sag / recipe.length, 1}, random);
        CHECK((fit_to(solid).rest_angle == 0) == (sag < 0.05));
    }
}

TEST_CASE("arcs: a horn's center line is found, though it tapers") {
    std::mt19937 random(64);
    const Recipe recipe{.columns = 32, .rows = 80, .length = 14, .noise = 0.01};
    const paper::Pose rest{1.2, 0.7};
    const paper::ClosedForm map({.length = 14, .radius = 1}, rest);
    const Solid horn = warped(test::cylinder(recipe, random), [&](glm::dvec3 p) {
        return map.position(paper::to_cylindrical({(1 - 0.05 * p.z) * glm::dvec2(p), p.z}));
    });
    const Cylinder fitted = fit_to(horn, glm::dvec3(map.center(14)));
    // The center line keeps its curvature and its length; the outer line is that of the mean radius.
    CHECK(std::abs(fitted.rest_angle - 1.2) < 1.6e-3);
    CHECK(arc_miss(fitted, recipe, rest, {}).direction < 1.6e-4);
    CHECK(std::abs(fitted.length - fitted.rest_angle * fitted.radius - (14 - 1.2)) < 5e-4);
}

TEST_CASE("arcs: a banana's center line is found, though its ends are thin") {
    std::mt19937 random(65);
    const Recipe recipe{.columns = 20, .rows = 80, .length = 10};
    const auto thickness = [](double z) {
        const double u = z / 10;
        return std::min({1.0, 0.2 + 3 * std::max(u - 0.05, 0.0), 0.15 + 4 * (1 - u)});
    };
    for (const double angle : {40.0, 70.0}) {
        CAPTURE(angle);
        const paper::ClosedForm map({.length = 10, .radius = 1}, {angle * degree, 0.7});
        const Solid banana = warped(test::cylinder(recipe, random), [&](glm::dvec3 p) {
            return map.position(paper::to_cylindrical({thickness(p.z) * glm::dvec2(p), p.z}));
        });
        CHECK(std::abs(fit_to(banana).rest_angle / degree - angle) < 2);
    }
}

TEST_CASE("arcs: a tube of few rows is bent as well") {
    std::mt19937 random(67);
    const auto check = [&](double angle, int rows) {
        const double length = 5 * angle * degree;  // of the outer line: four radii from the center
        const Recipe recipe{.columns = 12, .rows = rows, .length = length, .closed = false};
        const Solid solid = bent_cylinder(recipe, {angle * degree, 0.3}, random);
        CAPTURE(angle);
        CAPTURE(rows);
        CHECK(std::abs(fit_to(solid).rest_angle - angle * degree) < 0.1);
    };
    for (const int rows : {3, 4, 6}) check(180, rows);
    check(90, 2);
}

TEST_CASE("arcs: a disc is none about its rim, nor is a ring, nor a trunk with a branch") {
    std::mt19937 random(65);
    const auto ball =
        test::warped(test::cylinder({.columns = 32, .rows = 48, .length = 2}, random), [](glm::dvec3 p) {
            return glm::dvec3(std::sqrt(std::max(p.z * (2 - p.z), 0.0)) * glm::dvec2(p), p.z);
        });
    for (const double thin : {0.1, 0.2, 0.3}) {
        const Solid disc =
            test::warped(ball, [&](glm::dvec3 p) { return glm::dvec3(p.x, thin * p.y, 1.3 * p.z); });
        CHECK(fit_to(disc, glm::dvec3(0, 0, 1)).rest_angle == 0);
    }
    const paper::ClosedForm about({.length = 60, .radius = 1}, {2 * std::numbers::pi - 1e-6, 0});
    const Solid ring = test::warped(test::cylinder({.rows = 200, .length = 60, .closed = false}, random),
                                    [&](glm::dvec3 p) { return about.position(paper::to_cylindrical(p)); });
    CHECK(fit_to(ring, glm::dvec3(0, 0, 1)).rest_angle == 0);
    Solid tree = test::cylinder({.columns = 24, .rows = 60, .length = 20}, random);
    const Solid branch = test::cylinder({.columns = 24, .rows = 30, .length = 9}, random);
    for (const double side : {0.5, 0.9}) {
        Solid both = tree;
        const auto before = static_cast<std::uint32_t>(both.positions.size());
        for (const glm::vec3& p : branch.positions)
            both.positions.emplace_back(0.5 * p.x + side * p.z, 0.5 * p.y, 10 + p.z);
        for (const std::uint32_t i : branch.triangles) both.triangles.push_back(before + i);
        CHECK(fit::fit_cylinder(both.geometry(), std::nullopt, fit::RestPose::chain).arcs.empty());
    }
}

TEST_CASE("arcs: a given axis is the way from base to tip, and turns the body round") {
    std::mt19937 random(65);
    const Recipe recipe{.columns = 32, .rows = 60, .length = 12};
    const paper::Pose rest{1.4, -0.5};
    const Solid solid = bent_cylinder(recipe, rest, random);
    const paper::ClosedForm map({.length = 12, .radius = 1}, rest);
    const glm::dvec3 chord = map.center(12), aside(0.3, 0.2, 0);
    for (const glm::dvec3& axis : {chord, 5.0 * (glm::normalize(chord) + aside)}) {
        const Cylinder there = fit_to(solid, axis), back = fit_to(solid, -axis);
        CHECK(std::abs(there.rest_angle - 1.4) < 1.5e-7);
        CHECK(std::abs(back.rest_angle - 1.4) < 1.5e-7);
        CHECK(glm::length(there.origin) < 1e-7);
        CHECK(glm::length(there.axis - glm::dvec3(0, 0, 1)) < 5e-8);
        CHECK(std::abs(wrapped(there.rest_direction + 0.5)) < 2e-8);
        CHECK(glm::length(back.origin - chord) < 1e-6);
    }
    // For an axis across the body no arc is taken; the result is the straight fit along that axis.
    const glm::dvec3 across(-std::sin(-0.5), std::cos(-0.5), 0);
    CHECK(fit_to(solid, across).rest_angle == 0);
    CHECK(glm::length(fit_to(solid, across).axis - across) < 1e-15);
    // A straight body has no arc, however far off the given axis is.
    const Solid straight = test::cylinder(recipe, random);
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.2, 0.1, 1));
    CHECK(fit_to(straight, tilted).rest_angle == 0);
    CHECK(glm::length(fit_to(straight, tilted).axis - tilted) < 1e-15);
}

TEST_CASE("arcs: the result does not depend on duplicated or unused vertices, winding or order") {
    std::mt19937 random(66);
    const Recipe recipe{.columns = 24, .rows = 40, .length = 9, .jitter = 0.3, .noise = 0.01};
    const Solid solid =
        test::placed(bent_cylinder(recipe, {1.8, 2}, random), test::random_placing(5, random));
    const Cylinder expected = fit_to(solid);
    CHECK(expected.rest_angle > 1.5);
    const Cylinder fitted = fit_to(test::scrambled(solid));
    CHECK(std::abs(fitted.rest_angle - expected.rest_angle) < 1e-8);
    CHECK(std::abs(wrapped(fitted.rest_direction - expected.rest_direction)) < 5e-8);
    CHECK(glm::length(fitted.axis - expected.axis) < 5e-8);
    CHECK(glm::length(fitted.origin - expected.origin) < 2e-8 * expected.length);
    CHECK(std::abs(fitted.length / expected.length - 1) < 1e-9);
    CHECK(std::abs(fitted.radius / expected.radius - 1) < 1e-9);
}

TEST_CASE("arcs: hostile but valid meshes end in an error or in a cylinder that passes check") {
    std::mt19937 random(67);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const std::vector<float> numbers{0.0f, 1.0f, -1.0f, 1e-20f, 1e-6f, 3e38f, -3e38f, 1e4f, 0.5f};
    const int rounds = test::rounds(1000, 30);
    int fitted = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto number = [&] { return round % 3 == 0 ? uniform(random) : numbers[random() % 9]; };
        Solid solid;
        for (int i = 0; i < 8; ++i) solid.positions.push_back(glm::vec3{number(), number(), number()});
        for (int i = 0; i < 24; ++i) solid.triangles.push_back(static_cast<std::uint32_t>(random() % 8));
        std::optional<glm::dvec3> axis;
        if (round % 2 == 0) axis = glm::dvec3{number(), number(), number()};
        try {
            const Cylinder cylinder = fit_to(solid, axis);
            REQUIRE_NOTHROW(fit::check(cylinder));
            REQUIRE(2 * cylinder.rest_angle * cylinder.radius < cylinder.length * (1 + 1e-12));
            ++fitted;
        } catch (const fit::Error& error) {
            REQUIRE(std::string(error.what()).find("nan") == std::string::npos);
        }
    }
    CHECK(fitted > rounds / 3);
}

TEST_CASE("arcs: folds are counted along the arc") {
    std::mt19937 random(68);
    const Recipe recipe{.columns = 24, .rows = 97, .length = 15};
    for (const double angle : {0.5, 1.5, 2.6}) {
        const Solid solid = bent_cylinder(recipe, {angle, 1}, random);
        CHECK(fit::folds_capacity(solid.geometry(), fit_to(solid)) == 6);
    }
}

TEST_CASE("arcs: rows that refining adds lie evenly along the arc, however large it is") {
    std::mt19937 random(70);
    const Recipe recipe{.columns = 24, .rows = 7, .length = 15};
    for (const double angle : {0.5, 1.5, 2.6}) {
        const Solid unit = bent_cylinder(recipe, {angle, 1}, random);
        for (const double scale : {1e-9, 1.0, 1e9}) {
            const Solid solid = test::placed(unit, {.scale = scale});
            const Cylinder base = fit_to(solid);
            REQUIRE(base.rest_angle > 0);
            const fit::Refinement refinement = fit::refine(solid.geometry(), base, 6);
            const Solid fine{fit::refined_positions(solid.positions, refinement), refinement.triangles};
            CHECK(fit::folds_capacity(fine.geometry(), base) == 6);
        }
    }
}

TEST_CASE("arcs: what lies across the gap between the ends is not refined, and stays closed") {
    std::mt19937 random(66);
    const paper::Pose rest{5, 0.4};
    const paper::ClosedForm map({.length = 30, .radius = 1}, rest);
    Solid solid = test::warped(test::cylinder({.columns = 16, .rows = 40, .length = 30}, random),
                               [&](glm::dvec3 p) { return map.position(paper::to_cylindrical(p)); });
    Cylinder base = fit_to(solid);
    REQUIRE(base.rest_angle > 4.9);
    // A membrane between both ends, and one between an end and the middle.
    const auto last = static_cast<std::uint32_t>(16 * 40);
    for (const std::uint32_t to : {last, last - 1, last / 2})
        solid.triangles.insert(solid.triangles.end(), {0, to, to + 1, 0, to + 1, 1});
    solid.triangles.insert(solid.triangles.end(), {0, last / 2, last, last / 4, 0, last});
    const fit::Refinement refined = fit::refine(solid.geometry(), base, 60);
    const Solid after = test::applied(solid, refined);
    CHECK(test::border(after) == doctest::Approx(test::border(solid)).epsilon(1e-6));
    CHECK(after.triangles.size() > 10 * solid.triangles.size());
    double least = 1;
    for (std::size_t t = 0; t < after.triangles.size() / 3; ++t)
        least = std::min(least, test::quality(after, t));
    CHECK(least > 1e-5);
    CHECK_NOTHROW((void)fit::bind(after.geometry(), base));
}

TEST_CASE("arcs: the time a fit takes") {
    std::mt19937 random(69);
    for (const int rows : {100, 1000}) {
        const Recipe recipe{.columns = 100, .rows = rows, .length = 12, .noise = 0.01};
        const Solid solid = bent_cylinder(recipe, {1.5, 1}, random);
        const auto start = std::chrono::steady_clock::now();
        CHECK(fit_to(solid).rest_angle > 1);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        MESSAGE(solid.positions.size(), " vertices: ", taken.count(), " ms");
    }
}
