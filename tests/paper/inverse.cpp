// SPDX-License-Identifier: MIT
#include "support/angles.hpp"
#include "support/worst.hpp"

#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using namespace goffer::paper;
using goffer::test::pi;

namespace {

struct Case {
    Parameters body;
    Pose rest;
};

struct RandomArcs {
    std::mt19937 engine{1261};
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

    /// A body of any size and any arc that has an inverse; some arcs go nearly all the way round.
    Case bent(double share = 0.98) {
        const double length = std::pow(10, in(-3, 3)), slender = in(4, 30);
        const double most = std::min(2 * pi, slender / 2);
        return {{.length = length, .radius = length / slender}, {share * most * in(-1, 1), in(-7, 7)}};
    }
};

Cylindrical inverse(const glm::dvec3& point, const Case& c) {
    return to_cylindrical(point, c.body.length, c.body.radius, c.rest);
}

/// How far apart two vertices are in (beta, z, rho), as a length.
double apart(const Cylindrical& a, const Cylindrical& b) {
    return std::hypot(b.z - a.z, glm::length(from_cylindrical(a) - from_cylindrical(b)));
}

}  // namespace

TEST_CASE("inverse of the bend: there and back, within 1e-12 L") {
    RandomArcs random;
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const Case c = random.bent();
        const double length = c.body.length;
        const Cylindrical v{random.in(-7, 7), random.in(0, length), c.body.radius * random.in(0, 1)};
        goffer::test::take_worst(worst,
                                 apart(inverse(ClosedForm(c.body, c.rest).position(v), c), v) / length);
    }
    CAPTURE(worst);
    CHECK(worst < 1e-14);
}

TEST_CASE("inverse of the bend: any place has one vertex, and it maps to that place") {
    RandomArcs random;
    for (int i = 0; i < 20000; ++i) {
        const Case c = random.bent();
        const double reach = 2 * c.body.length;
        const glm::dvec3 p{random.in(-reach, reach), random.in(-reach, reach), random.in(-reach, reach)};
        const Cylindrical v = inverse(p, c);
        CHECK(glm::length(ClosedForm(c.body, c.rest).position(v) - p) < 5e-14 * c.body.length);
        CHECK(v.rho >= 0);
        CHECK(std::abs(v.beta) <= pi);
    }
}

TEST_CASE("inverse of the bend: the center line, the ends, and the arc's continuation beyond them") {
    RandomArcs random;
    for (int i = 0; i < 2000; ++i) {
        const Case c = random.bent(0.9);
        const double length = c.body.length;
        const ClosedForm map(c.body, c.rest);
        for (const double u : {0.0, 0.3, 1.0, -0.01, 1.01, -0.04, 1.04}) {
            const Cylindrical on_line = inverse(map.center(u * length), c);
            CHECK(on_line.z == doctest::Approx(u * length).epsilon(1e-12));
            CHECK(on_line.rho < 1e-13 * length);
            const Cylindrical skin{random.in(-pi, pi), u * length, c.body.radius};
            CHECK(apart(inverse(map.position(skin), c), skin) < 1e-14 * length);
        }
        CHECK(inverse({0, 0, 0}, c).z == 0);
        CHECK(inverse({0, 0, 0}, c).beta == 0);
    }
}

TEST_CASE(
    "inverse of the bend: without an angle it is the straight one to the bit, and goes there smoothly") {
    RandomArcs random;
    for (int i = 0; i < 1000; ++i) {
        Case c = random.bent();
        const double length = c.body.length;
        const glm::dvec3 p{random.in(-1, 1) * length, random.in(-1, 1) * length, random.in(-1, 2) * length};
        const Cylindrical straight = to_cylindrical(p);
        for (const double angle : {0.0, -0.0, 5e-324, 1e-310, 1e-200, 1e-101, 1e-99, 1e-30, 1e-17}) {
            c.rest.angle = angle;
            const Cylindrical v = inverse(p, c);
            CHECK(v.beta == doctest::Approx(straight.beta).epsilon(1e-15));
            CHECK(v.z == doctest::Approx(straight.z).epsilon(1e-15));
            CHECK(v.rho == doctest::Approx(straight.rho).epsilon(1e-15));
            if (angle != 0) continue;
            CHECK(v.beta == straight.beta);
            CHECK(v.z == straight.z);
            CHECK(v.rho == straight.rho);
        }
        // To first order in alpha: half as far from the straight one at half the angle.
        const auto off = [&](double angle) {
            c.rest.angle = angle;
            return apart(inverse(p, c), straight);
        };
        CHECK(off(1e-7) / off(5e-8) == doctest::Approx(2).epsilon(1e-4));
    }
}

TEST_CASE("inverse of the bend: a negative angle is the other direction") {
    RandomArcs random;
    for (int i = 0; i < 200; ++i) {
        const Case c = random.bent();
        const glm::dvec3 p = c.body.length * glm::dvec3(random.in(-1, 1), random.in(-1, 1), random.in(0, 1));
        const Case other{c.body, {-c.rest.angle, c.rest.direction + pi}};
        CHECK(apart(inverse(p, c), inverse(p, other)) < 1e-14 * c.body.length);
    }
}

TEST_CASE("inverse of the bend: what has none is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto with = [](double length, double radius, double angle, double direction = 0) {
        return to_cylindrical({0.1, 0.2, 3}, length, radius, {angle, direction});
    };
    CHECK_NOTHROW(with(10, 0.1, 6.28));
    CHECK_THROWS_AS(with(10, 0.1, 6.3), std::invalid_argument);
    CHECK_THROWS_AS(with(10, 0.1, -6.3), std::invalid_argument);
    CHECK_THROWS_AS(with(10, 1, 5), std::invalid_argument);
    CHECK_THROWS_AS(with(10, 1, nan), std::invalid_argument);
    CHECK_THROWS_AS(with(10, 1, 1, nan), std::invalid_argument);
    CHECK_THROWS_AS(with(0, 1, 0), std::invalid_argument);
    CHECK_THROWS_AS(with(10, -1, 0), std::invalid_argument);
}
