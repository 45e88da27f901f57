// SPDX-License-Identifier: MIT
#include "support/worst.hpp"
#include "surface.hpp"

#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

using namespace goffer::paper;
using goffer::test::pi;

namespace {

struct RandomBodies {
    std::mt19937 engine{20150601};
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

    Parameters body(Amplitude amplitude = Amplitude::paper) {
        const double length = in(0.5, 20);
        const double kind = in(0, 3);
        const Profile even{Profile::Kind::even, in(0, 0.5)};
        const Profile profile = kind < 1 ? Profile::damped : kind < 2 ? Profile::smooth : even;
        return {length, length / in(4, 30), static_cast<int>(in(1, 9)), profile, amplitude};
    }
    /// Thicker here than there, with folds of several lengths that fade.
    Parameters shaped_body() {
        Parameters body = this->body();
        Shape::Knots knots;
        for (int i = 0; i < 9; ++i) {
            knots.radius.push_back(body.radius * in(0.6, 1.4));
            knots.fold_length.push_back(in(0.5, 1.5));
            knots.weight.push_back(in(0, 1.5));
        }
        body.shape = std::make_shared<const Shape>(body.length, body.radius, knots);
        body.radius = body.shape->radius();
        return body;
    }
    Cylindrical vertex(const Parameters& body, double least = 0) {
        return {in(-7, 7), in(0, body.length), body.radius * in(least, 1.6)};
    }
    Pose pose(const Parameters& body, double share = 0.8) {
        return {share * in(0.05, 1) * std::min(pi, body.length / (2 * body.radius)), in(-7, 7)};
    }
    CylindricalVector vector() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
};

glm::dvec3 along_z(const glm::dvec3& v, double angle) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y,
            v.z};
}

// A vector of the rest frame at a vertex, in the body frame.
glm::dvec3 at_rest(const Cylindrical& vertex, const CylindricalVector& v) {
    return along_z({v.rho, v.beta, v.z}, vertex.beta);
}

// Derivative of the map along e_rho, e_beta or e_z, by differences of the fourth order.
glm::dvec3 difference(const ClosedForm& map, const Cylindrical& v, int axis, double h) {
    const auto at = [&](double step) {
        Cylindrical moved = v;
        (axis == 0 ? moved.rho : axis == 1 ? moved.beta : moved.z) += axis == 1 ? step / v.rho : step;
        return map.position(moved);
    };
    return (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

/// Mid-height in folds is elsewhere in a body with a shape.
bool near_mid_folds(const Parameters& body, const Cylindrical& v) {
    if (!body.shape || body.profile.kind != Profile::Kind::damped) return false;
    const double h = 5e-3 * body.length;
    const auto wave = [&](double z) { return body.shape->wave(Profile::smooth, 1, z); };
    const auto rises = [&](double z) { return wave(z + 1e-6 * h) > wave(z); };
    return rises(v.z - h) != rises(v.z + h);
}

bool near_a_crease(const Parameters& body, const Pose& pose, const Cylindrical& v) {
    const double margin = 5e-3;
    const double radius = body.shape ? body.radius * body.shape->scale(v.z) : body.radius;
    const double theta = pose.angle < 0 ? pose.direction + pi : pose.direction;
    return std::abs(std::cos((v.beta - theta) / 2)) < margin ||
           std::abs(2 * v.z / body.length - 1) < margin || v.z < margin * body.length ||
           v.z > (1 - margin) * body.length || std::abs(v.rho - radius / 2) < margin * body.radius ||
           v.rho < 10 * margin * body.radius || near_mid_folds(body, v);
}

}  // namespace

TEST_CASE("P1: without an angle the rest shape comes back, to the bit") {
    RandomBodies random;
    for (int i = 0; i < 500; ++i) {
        const Parameters body =
            i % 3 == 0 ? random.shaped_body() : random.body(i % 2 ? Amplitude::area : Amplitude::paper);
        const Cylindrical v = random.vertex(body);
        const CylindricalVector n = random.vector();
        const ClosedForm map(body, {0, random.in(-7, 7)});
        CHECK(map.position(v) == from_cylindrical(v));
        const glm::dvec3 rest = glm::normalize(at_rest(v, n));
        CHECK(glm::length(map.normal(v, n) - rest) < 1e-14);
        CHECK(glm::length(map.tangent(v, n) - rest) < 1e-14);
    }
}

TEST_CASE("the map is continuous at rest: the bend like the angle, the wrinkle like its root") {
    RandomBodies random;
    for (int i = 0; i < 200; ++i) {
        const Parameters body = random.body(), bare{body.length, body.radius, 0};
        const Cylindrical v = random.vertex(body);
        for (const double angle : {1e-7, 1e-12, 1e-300}) {
            const Pose pose{angle, random.in(-7, 7)};
            const double c = std::cos(v.beta - pose.direction);
            const glm::dvec3 moved = ClosedForm(bare, pose).position(v) - from_cylindrical(v);
            const double x = angle * v.z * v.z / (2 * body.length);
            const double z = -angle * v.z / body.length * (body.radius + v.rho * c);
            const glm::dvec3 first_order = along_z({x, 0, z}, pose.direction);
            CHECK(glm::length(moved - first_order) <= 4 * angle * angle * body.length + 1e-15 * body.length);
            const double wrinkle =
                glm::length(ClosedForm(body, pose).position(v) - ClosedForm(bare, pose).position(v));
            CHECK(wrinkle <= std::sqrt(angle * body.radius * body.length) + 1e-15 * body.length);
        }
    }
}

TEST_CASE("P8: a turn about the axis commutes with the bend") {
    RandomBodies random;
    for (int i = 0; i < 300; ++i) {
        const Parameters body = random.body(i % 3 ? Amplitude::paper : Amplitude::area);
        const Cylindrical v = random.vertex(body);
        const CylindricalVector n = random.vector();
        const Pose pose = random.pose(body);
        const ClosedForm map(body, pose), straight(body, {pose.angle, 0});
        const Cylindrical turned{v.beta - pose.direction, v.z, v.rho};
        const auto back = [&](const glm::dvec3& p) { return along_z(p, pose.direction); };
        CHECK(glm::length(map.position(v) - back(straight.position(turned))) < 1e-14 * body.length);
        CHECK(glm::length(map.normal(v, n) - back(straight.normal(turned, n))) < 1e-14);
        CHECK(glm::length(map.tangent(v, n) - back(straight.tangent(turned, n))) < 1e-14);
        CHECK(glm::length(map.center(v.z) - back(straight.center(v.z))) < 1e-14 * body.length);
    }
}

TEST_CASE("a negative angle bends the other way") {
    RandomBodies random;
    for (int i = 0; i < 100; ++i) {
        const Parameters body = random.body();
        const Cylindrical v = random.vertex(body);
        const Pose pose = random.pose(body);
        const ClosedForm there(body, {-pose.angle, pose.direction}),
            here(body, {pose.angle, pose.direction + pi});
        CHECK(there.position(v) == here.position(v));
    }
}

TEST_CASE("tangents are the map's derivatives, normals stand on them") {
    RandomBodies random;
    double worst = 0;
    int looked_at = 0;
    for (int i = 0; i < 1500; ++i) {
        const Parameters body =
            i % 4 == 1 ? random.shaped_body() : random.body(i % 3 ? Amplitude::paper : Amplitude::area);
        const double share = body.shape ? 0.5 : 0.8;  // not beyond what its thickest part bears
        const Pose pose = random.pose(body, i % 2 ? share : -share);
        const Cylindrical v = random.vertex(body);
        if (near_a_crease(body, pose, v)) continue;
        ++looked_at;
        const ClosedForm map(body, pose);
        const double h = 1e-4 * body.radius;
        const glm::dvec3 by_rho = difference(map, v, 0, h), by_beta = difference(map, v, 1, h);
        const glm::dvec3 by_z = difference(map, v, 2, h);
        const CylindricalVector t = random.vector(), n = random.vector();

        const glm::dvec3 tangent = glm::normalize(t.rho * by_rho + t.beta * by_beta + t.z * by_z);
        goffer::test::take_worst(worst, glm::length(map.tangent(v, t) - tangent));
        // Cofactors: the normal of the plane that the images of two vectors normal to n span.
        const glm::dvec3 normal =
            glm::normalize(n.rho * glm::cross(by_beta, by_z) + n.beta * glm::cross(by_z, by_rho) +
                           n.z * glm::cross(by_rho, by_beta));
        goffer::test::take_worst(worst, glm::length(map.normal(v, n) - normal));
    }
    CAPTURE(worst);
    CHECK(looked_at > 1000);
    CHECK(worst < 2e-10);
}

TEST_CASE("a tangent that was normal to the normal stays so, and both have unit length") {
    RandomBodies random;
    for (int i = 0; i < 1000; ++i) {
        const Parameters body = random.body();
        const ClosedForm map(body, random.pose(body));
        const Cylindrical v = random.vertex(body);
        const CylindricalVector n = random.vector(), other = random.vector();
        const glm::dvec3 cross =
            glm::cross(glm::dvec3(n.rho, n.beta, n.z), glm::dvec3(other.rho, other.beta, other.z));
        const glm::dvec3 normal = map.normal(v, n), tangent = map.tangent(v, {cross.x, cross.y, cross.z});
        CHECK(std::abs(glm::dot(normal, tangent)) < 1e-14);
        CHECK(std::abs(glm::length(normal) - 1) < 1e-14);
        CHECK(std::abs(glm::length(tangent) - 1) < 1e-14);
    }
}

TEST_CASE("on a crease the normal is the mean of both sides") {
    const Parameters body{10, 1, 4};
    const ClosedForm map(body, {1.5, 0.4});
    const auto normal = [&](double beta, double z) { return map.normal({beta, z, 1}, {1, 0, 0}); };
    const glm::dvec3 forward = normal(0.4, 5 + 0.01), back = normal(0.4, 5 - 0.01);
    CHECK(glm::dot(forward, back) < 0.99);
    CHECK(glm::length(normal(0.4, 5) - glm::normalize(forward + back)) < 1e-14);
    const double outer = 0.4 + pi;
    const glm::dvec3 left = normal(outer - 0.01, 4), right = normal(outer + 0.01, 4);
    CHECK(glm::dot(left, right) < 0.999);
    CHECK(glm::length(normal(outer, 4) - glm::normalize(left + right)) < 0.015);
    for (const double z : {4.999, 4.9999, 5.0001, 5.001}) CHECK(std::isfinite(normal(0.4, z).x));
}

TEST_CASE("on the axis everything is finite, and the axis stays the center line") {
    const Parameters body{10, 1, 4};
    const ClosedForm map(body, {1.5, 0.4});
    CHECK(glm::length(map.position({0, 3, 0}) - map.center(3)) < 1e-14);
    const glm::dvec3 along = map.tangent({0, 3, 0}, {0, 0, 1});
    const glm::dvec3 numeric = glm::normalize(map.center(3.001) - map.center(2.999));
    CHECK(glm::length(along - numeric) < 1e-13);
    for (const CylindricalVector v : {CylindricalVector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        CHECK(std::abs(glm::length(map.normal({0, 3, 0}, v)) - 1) < 1e-14);
        CHECK(glm::length(map.normal({0, 3, 0}, v) - map.normal({0, 3, 1e-9}, v)) < 4e-9);
    }
}

TEST_CASE("cylinder coordinates and back") {
    RandomBodies random;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p{random.in(-2, 2), random.in(-2, 2), random.in(-2, 2)};
        CHECK(glm::length(from_cylindrical(to_cylindrical(p)) - p) < 1e-15 * 4);
    }
    CHECK(to_cylindrical({-0.0, 0, 1}).beta == 0);
}

TEST_CASE("poses and bodies that have no map are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(ClosedForm({10, 1, 3}, {5, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, 1, 3}, {-5, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, 1, 3}, {nan, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, 1, 3}, {1, nan}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({0, 1, 3}, {1, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, nan, 3}, {1, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, 0, 3}, {1, 0}), std::invalid_argument);
    CHECK_THROWS_AS(ClosedForm({10, 1, -1}, {1, 0}), std::invalid_argument);
    CHECK_NOTHROW(ClosedForm({10, 1, 3}, {4.999, 0}));
}

TEST_CASE("with amplitude `area` a rest arc is refused, and so is an onset without one") {
    Parameters body{10, 1, 3};
    body.amplitude = Amplitude::area;
    CHECK_NOTHROW(ClosedForm(body, {1, 0}));
    body.onset = 0.01;
    CHECK_THROWS_AS(ClosedForm(body, {1, 0}), std::invalid_argument);
    body.onset = 0;
    body.rest_angle = 0.5;
    CHECK_THROWS_AS(ClosedForm(body, {1, 0}), std::invalid_argument);
    body.amplitude = Amplitude::paper;
    CHECK_NOTHROW(ClosedForm(body, {1, 0}));
}
