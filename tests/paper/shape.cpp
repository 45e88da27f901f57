// SPDX-License-Identifier: MIT
#include "support/worst.hpp"
#include "surface.hpp"

#include <goffer/paper/closed_form.hpp>
#include <goffer/paper/shape.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

/// Shapes along a body, and the lengths that columns keep part by part.

using namespace goffer::paper;
using goffer::test::degree;
using goffer::test::pi;

namespace {

std::vector<double> random_values(std::mt19937& random, std::size_t count, double low, double high) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(std::uniform_real_distribution<double>(low, high)(random));
    return values;
}

/// Length of the image of a column between two heights.
double length_of_image(const ClosedForm& map, double beta, double rho, double low, double high) {
    constexpr int steps = 4000;
    double length = 0;
    glm::dvec3 last = map.position({beta, low, rho});
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec3 next = map.position({beta, low + (high - low) * i / steps, rho});
        length += glm::length(next - last);
        last = next;
    }
    return length;
}

/// How far the folds of the inner column of a tube (L / r = 10) are from the length that they had.
std::pair<double, double> errors_of_folds(Profile profile, int folds, double angle) {
    const ClosedForm map({10, 1, folds, profile}, {angle, 0});
    const int count = profile.folds_of_length(folds);
    double square = 0, worst = 0;
    for (int i = 0; i < count; ++i) {
        const double low = 10.0 * i / count, high = 10.0 * (i + 1) / count;
        const double error = length_of_image(map, 0, 1, low, high) / (high - low) - 1;
        square += error * error / count;
        if (std::abs(error) > std::abs(worst)) worst = error;
    }
    return {std::sqrt(square), worst};
}

}  // namespace

TEST_CASE("splines: straight lines are met, slope and integral are those of the value") {
    const Spline line(4, {1, 2, 3});
    for (const double z : {0.0, 0.3, 1.9, 2.0, 3.7, 4.0}) {
        CHECK(line(z) == doctest::Approx(1 + z / 2).epsilon(1e-14));
        CHECK(line.slope(z) == doctest::Approx(0.5).epsilon(1e-14));
        CHECK(line.integral(z) == doctest::Approx(z + z * z / 4).epsilon(1e-14));
    }
    CHECK(line(-1) == line(0));
    CHECK(line(5) == line(4));
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const std::vector<double> values = random_values(random, 2 + random() % 9, 0.1, 2);
        const Spline spline(3, values);
        const auto [low, high] = std::ranges::minmax(values);
        for (const double z : random_values(random, 20, 0.01, 2.99)) {
            const double h = 1e-5;
            CHECK(spline(z) >= low - 1e-12);
            CHECK(spline(z) <= high + 1e-12);
            CHECK(spline.slope(z) ==
                  doctest::Approx((spline(z + h) - spline(z - h)) / (2 * h)).epsilon(1e-6));
            CHECK(spline(z) ==
                  doctest::Approx((spline.integral(z + h) - spline.integral(z - h)) / (2 * h)).epsilon(1e-8));
        }
        CHECK(spline(0) == doctest::Approx(values.front()));
        CHECK(spline(3) == doctest::Approx(values.back()));
        double largest = 0;
        for (int i = 0; i <= 3000; ++i) largest = std::max(largest, spline(i * 1e-3));
        CHECK(spline.largest() > largest - 1e-12);
        CHECK(spline.largest() < largest + 1e-5);
    }
}

TEST_CASE("shapes: the drift vanishes at both ends, and the arc angle is inverted") {
    std::mt19937 random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const Shape shape(10, 1, {.radius = random_values(random, 8, 0.5, 1.5)});
        CHECK(shape.drift(0) == 0);
        CHECK(shape.drift(10) == 0);
        CHECK(std::abs(shape.drift(10 - 1e-9)) < 1e-8);
        for (const double z : random_values(random, 10, 0, 10)) {
            const double h = 1e-5, curvature = 0.9 * pi / 10;
            if (z > h && z < 10 - h) {
                CHECK(shape.radius() * (shape.scale(z) - 1) ==
                      doctest::Approx((shape.drift(z + h) - shape.drift(z - h)) / (2 * h)).epsilon(1e-6));
            }
            CHECK(shape.unshifted(z - curvature * shape.drift(z), curvature) ==
                  doctest::Approx(z).epsilon(1e-12));
            CHECK(shape.max_scale() >= shape.scale(z) - 1e-4);
        }
        CHECK(shape.unshifted(-1, 0.2) == -1);
        CHECK(shape.unshifted(11, 0.2) == 11);
    }
}

TEST_CASE("shapes: folds of one length have the profile's own shape, others are as deep as they are long") {
    const Shape same(10, 1, {});
    for (const Profile profile : {Profile::damped, Profile::smooth, Profile::even}) {
        for (const double z : {0.0, 1.3, 5.2, 9.9}) {
            CHECK(same.wave(profile, 6, z) ==
                  doctest::Approx(shape(profile, 6, std::abs(2 * z / 10 - 1))).epsilon(1e-12).scale(1));
            CHECK(same.wave_slope(profile, 6, z) ==
                  doctest::Approx(shape_slope_z(profile, 6, 10, z)).epsilon(1e-10).scale(1));
        }
    }
    CHECK(same.scale(3) == 1);
    CHECK(same.drift(3) == 0);
    // Twice as thick at the end: there are ln 2 folds' share of the count in proportion.
    const Shape cone(10, 1, {.radius = {1, 2}});
    CHECK(cone.folds() == doctest::Approx(10 * std::log(2.0)).epsilon(1e-12));
    CHECK(cone.max_scale() > 0.999 * cone.scale(10));
    double thin = 0, thick = 0;
    for (double z = 0; z <= 10; z += 1e-3) {
        double& deepest = z < 5 ? thin : thick;
        if (std::abs(z - 5) > 4) continue;
        deepest = std::max(deepest, -cone.wave(Profile::even, 24, z) / cone.scale(z));
    }
    CHECK(thin == doctest::Approx(thick).epsilon(0.02));
}

TEST_CASE("the cone's outer line keeps its length in every fifth") {
    const auto shape = std::make_shared<const Shape>(10.0, 1.0, Shape::Knots{.radius = {1.4, 0.3}});
    Parameters cone{10, shape->radius(), 0};
    cone.shape = shape;
    const ClosedForm shaped(cone, {90 * degree, 0.3}), plain({10, shape->radius(), 0}, {90 * degree, 0.3});
    double worst_plain = 0;
    for (int fifth = 0; fifth < 5; ++fifth) {
        const double low = 2.0 * fifth;
        const auto length = [&](const ClosedForm& map) {
            constexpr int steps = 2000;
            double sum = 0;
            for (int i = 0; i < steps; ++i) {
                const double a = low + 2.0 * i / steps, b = low + 2.0 * (i + 1) / steps;
                const double at = shape->radius() * shape->scale(a), next = shape->radius() * shape->scale(b);
                sum += glm::length(map.position({0.3 + pi, b, next}) - map.position({0.3 + pi, a, at}));
            }
            return sum / std::hypot(2.0, 2 * shape->radius() * shape->scale_slope(low));
        };
        CHECK(length(shaped) == doctest::Approx(1).epsilon(0.01));
        goffer::test::take_worst(worst_plain, std::abs(length(plain) - 1));
    }
    CHECK(worst_plain > 0.05);
}

TEST_CASE("folds of one depth keep the length of every fold, not of the column alone") {
    for (const double angle : {90.0, 180.0}) {
        const auto [damped, damped_worst] = errors_of_folds(Profile::damped, 6, angle * degree);
        const auto [smooth, smooth_worst] = errors_of_folds(Profile::smooth, 6, angle * degree);
        const auto [even, even_worst] = errors_of_folds(Profile::even, 12, angle * degree);
        std::printf(
            "fold by fold, %3.0f deg, rms and worst: damped %.1f %+.1f %%, smooth %.1f %+.1f %%, "
            "even %.1f %+.1f %%\n",
            angle, 100 * damped, 100 * damped_worst, 100 * smooth, 100 * smooth_worst, 100 * even,
            100 * even_worst);
        CHECK(even < 0.3 * damped);
        CHECK(even < 0.3 * smooth);
        CHECK(std::abs(even_worst) < 0.5 * std::abs(damped_worst));
    }
}

TEST_CASE("shapes that none can be are refused") {
    const auto refused = [](const Shape::Knots& knots, double length = 1) {
        CHECK_THROWS_AS(Shape(length, 0.1, knots), std::invalid_argument);
    };
    refused({.radius = {1}});
    refused({.radius = {1, 0}});
    refused({.radius = {1, std::nan("")}});
    refused({.fold_length = {1, -1}});
    refused({.weight = {1, -0.1}});
    refused({.weight = {1, 5}});
    refused({}, 0);
    refused({}, std::nan(""));
    Parameters body{10, 1, 3};
    body.shape = std::make_shared<const Shape>(10.0, 1.0, Shape::Knots{.radius = {0.5, 1.5}});
    CHECK_NOTHROW(ClosedForm(body, {1, 0}));
    CHECK_THROWS_AS(ClosedForm(body, {4, 0}), std::invalid_argument);  // below 5, the limit of one radius
    body.radius = 1.1;
    CHECK_THROWS_AS(ClosedForm(body, {1, 0}), std::invalid_argument);
    body.radius = 1;
    body.amplitude = Amplitude::area;
    CHECK_THROWS_AS(ClosedForm(body, {1, 0}), std::invalid_argument);
}

TEST_CASE("a shaped body that is bent at rest: straightened vectors come back as they were") {
    std::mt19937 random(77);
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    double worst = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const auto shape =
            std::make_shared<const Shape>(10.0, 1.0, Shape::Knots{random_values(random, 6, 0.6, 1.4)});
        const Pose rest{in(0.1, 3), in(-3, 3)};
        Parameters body{.length = 10, .radius = shape->radius()};
        body.shape = shape;
        const ClosedForm map(body, rest);
        const Cylindrical at{in(-pi, pi), in(0, 10), in(0.1, 1)};
        const glm::dvec3 v = glm::normalize(glm::dvec3(in(-1, 1), in(-1, 1), in(-1, 1)));
        const CylindricalVector normal =
            straightened_normal(v, at, body.length, body.radius, rest, shape.get());
        const CylindricalVector tangent =
            straightened_tangent(v, at, body.length, body.radius, rest, shape.get());
        goffer::test::take_worst(worst, glm::length(map.normal(at, normal) - v));
        goffer::test::take_worst(worst, glm::length(map.tangent(at, tangent) - v));
    }
    CAPTURE(worst);
    CHECK(worst < 1e-13);
}
