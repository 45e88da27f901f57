// SPDX-License-Identifier: MIT
#include "synthetic.hpp"

#include <goffer/fit/suitability.hpp>

#include <doctest/doctest.h>

#include <cmath>

using namespace goffer;
using namespace goffer::test;

namespace {

/// `solid` with another copy of it, moved and scaled.
Solid with_copy(Solid solid, const glm::vec3& by, float scale = 1) {
    const auto first = static_cast<std::uint32_t>(solid.positions.size());
    const std::size_t corners = solid.triangles.size();
    for (std::uint32_t i = 0; i < first; ++i) solid.positions.push_back(scale * solid.positions[i] + by);
    for (std::size_t c = 0; c < corners; ++c) solid.triangles.push_back(first + solid.triangles[c]);
    return solid;
}

fit::Suitability shape(const Solid& solid) {
    return fit::suitability_of(solid.geometry(), upright());
}

}  // namespace

TEST_CASE("suitability: a tube is one round shell, also as a soup") {
    const Solid solid = tube();
    Solid soup;
    for (const std::uint32_t corner : solid.triangles) {
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(solid.positions[corner]);
    }
    for (const Solid& each : {solid, soup}) {
        CHECK(shape(each).shells == 1);
        CHECK(shape(each).side_by_side == 0);
        CHECK(shape(each).flatness == doctest::Approx(1).epsilon(0.03));
    }
}

TEST_CASE("suitability: flatness is that of an ellipse, whichever way it lies and however the body winds") {
    // Averages x^2 and y^2 of an ellipse with half axes a and b along its circumference.
    const double a = 1, b = 0.25;
    double xx = 0, yy = 0;
    for (int i = 0; i < 100000; ++i) {
        const double t = 2 * std::numbers::pi * i / 100000, c = a * std::cos(t), s = b * std::sin(t);
        const double speed = std::hypot(a * std::sin(t), b * std::cos(t));
        xx += speed * c * c;
        yy += speed * s * s;
    }
    const double truth = std::sqrt(xx / yy);
    for (const double turn : {0.0, 0.7}) {
        for (const double winding : {0.0, 1.0}) {
            Solid solid = tube(128);
            for (glm::vec3& p : solid.positions) {
                const double x = double{p.x} * a, y = double{p.y} * b + winding * std::sin(double{p.z} / 2);
                p.x = static_cast<float>(x * std::cos(turn) - y * std::sin(turn));
                p.y = static_cast<float>(x * std::sin(turn) + y * std::cos(turn));
            }
            CAPTURE(turn);
            CAPTURE(winding);
            CHECK(shape(solid).flatness == doctest::Approx(truth).epsilon(0.1));
        }
    }
}

TEST_CASE("suitability: shells lie side by side where they share heights and stand apart") {
    const auto between = [](Solid solid) {  // them runs the axis
        for (glm::vec3& p : solid.positions) p.x -= 1.05f;
        return shape(solid);
    };
    const auto beside = [&](const Solid& solid) { return between(solid).side_by_side; };
    CHECK(beside(with_copy(tube(), {2.1f, 0, 0})) == 2);
    CHECK(beside(with_copy(tube(), {1.9f, 0, 0})) == 0);     // into each other
    CHECK(beside(with_copy(tube(), {2.1f, 0, 4.9f})) == 2);  // over half of their length
    CHECK(beside(with_copy(tube(), {2.1f, 0, 5.1f})) == 0);
    CHECK(beside(with_copy(tube(), {0, 0, 11})) == 0);          // one behind the other
    CHECK(beside(with_copy(tube(), {0, 0, 2.5f}, 0.5f)) == 0);  // one in the other
    CHECK(beside(with_copy(tube(), {2.1f, 0, 0}, 0.1f)) == 0);  // too small to count
    CHECK(shape(with_copy(tube(), {2.1f, 0, 0}, 0.1f)).shells == 1);
    CHECK(beside(with_copy(with_copy(tube(), {0, 3, 0}), {3, 0, 0})) == 4);
    const fit::Suitability some = between(with_copy(with_copy(tube(), {2.1f, 0, 0}), {0, 0, 11}, 1));
    CHECK(some.side_by_side_share == doctest::Approx(1));
    const fit::Suitability half = between(with_copy(with_copy(tube(), {0, 0, 11}), {2.1f, 0, 2.5f}, 0.5f));
    CHECK(half.side_by_side == 2);
    CHECK(half.side_by_side_share == doctest::Approx(1.25 / 2.5));
}

TEST_CASE("suitability: what lies beside a shell that the axis runs through is a part of a body") {
    const fit::Suitability two = shape(with_copy(tube(), {2.1f, 0, 0}));
    CHECK(two.side_by_side == 1);
    CHECK(two.side_by_side_share == doctest::Approx(0.5));
    const fit::Suitability small = shape(with_copy(with_copy(tube(), {0, 0, 11}), {2.1f, 0, 2.5f}, 0.5f));
    CHECK(small.shells == 4);
    CHECK(small.side_by_side == 1);
    CHECK(small.side_by_side_share == doctest::Approx(0.25 / 2.5));
}

TEST_CASE("suitability: broken input is refused") {
    const Solid solid = tube();
    fit::Cylinder broken = upright();
    broken.radius = 0;
    CHECK_THROWS_AS((void)fit::suitability_of(solid.geometry(), broken), fit::Error);
    CHECK_THROWS_AS((void)fit::suitability_of({}, upright()), fit::Error);
}

TEST_CASE("suitability: what folds are missing for") {
    std::mt19937 random(1);
    const Solid fine = cylinder({.rows = 256}, random), coarse = cylinder({.rows = 4}, random);
    fit::Cylinder base = upright();
    const auto shortage = [&](const Solid& solid, const fit::BindOptions& options) {
        return fit::fold_shortages(fit::bind(solid.geometry(), base, options), options).at(0);
    };
    fit::BindOptions options;
    CHECK(shortage(fine, options) == fit::FoldShortage::none);
    CHECK(shortage(coarse, options) == fit::FoldShortage::rows);
    for (const auto kind : {fit::Profile::Kind::even, fit::Profile::Kind::damped}) {
        options.profile.kind = kind;
        options.folds = 3;
        CHECK(shortage(fine, options) == fit::FoldShortage::none);
        CHECK(shortage(coarse, options) == fit::FoldShortage::rows);
        options.folds = 0;
        CHECK(shortage(coarse, options) == fit::FoldShortage::none);
        options.folds.reset();
        CHECK(shortage(coarse, options) == fit::FoldShortage::rows);
        options.amplitude = fit::Amplitude::none;
        CHECK(shortage(coarse, options) == fit::FoldShortage::none);
        options.amplitude = fit::Amplitude::paper;
    }
    options = {};
    options.wrinkle_range = {0.5, 0.51};
    CHECK(shortage(fine, options) == fit::FoldShortage::range);
    options.wrinkle_range = {0.2, 0.8};
    CHECK(shortage(fine, options) == fit::FoldShortage::none);
    base.length = 2700;  // 2.6 for each of the most folds
    const Solid rope = cylinder({.columns = 4, .rows = 10000, .length = base.length}, random);
    CHECK(shortage(rope, {}) == fit::FoldShortage::length);
}
