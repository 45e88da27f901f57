// SPDX-License-Identifier: MIT
#include "synthetic.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/fit/sockets.hpp>
#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

/// Where on a mesh sockets are placed, and how they are turned there.

using namespace goffer;
using namespace goffer::test;

namespace {

/// How far `point` is from the nearest of places all over the surface, some 0.1 apart.
double distance_to(const Solid& solid, const glm::dvec3& point) {
    constexpr double steps = 20;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < solid.triangles.size(); t += 3) {
        const glm::dvec3 a = solid.positions[solid.triangles[t]], b = solid.positions[solid.triangles[t + 1]],
                         c = solid.positions[solid.triangles[t + 2]];
        for (double i = 0; i <= steps; ++i) {
            for (double j = 0; i + j <= steps; ++j) {
                const glm::dvec3 place = a + i / steps * (b - a) + j / steps * (c - a);
                least = std::min(least, glm::distance(place, point));
            }
        }
    }
    return least;
}

glm::dvec3 vector_of(const bend::RestVector& v) {
    return {v.rho, v.beta, v.z};
}

}  // namespace

TEST_CASE(
    "sockets: no place of the surface is nearer to a point than its socket, off edges and corners too") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> across(-2, 2), along(-1, 11);
    for (const bool closed : {true, false}) {
        const Solid solid = cylinder({.columns = 5, .rows = 4, .closed = closed}, random);
        const fit::Binding binding = fit::bind(solid.geometry(), upright());
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 point(across(random), across(random), along(random));
            const bend::RestVertex at = fit::socket_near(binding, solid.geometry(), point).vertex;
            const double distance = glm::distance(paper::from_cylindrical({at.beta, at.z, at.rho}), point);
            const double sampled = distance_to(solid, point);
            REQUIRE(distance < sampled + 1e-6);
            REQUIRE(distance > sampled - 0.1);
        }
    }
}

TEST_CASE("sockets: the first axis lies in the surface, toward the tip or, on a cap, away from the axis") {
    std::mt19937 random(2);
    Solid cone = cylinder({.columns = 12, .rows = 10}, random);
    for (glm::vec3& p : cone.positions) p.x *= 1 - 0.08f * p.z, p.y *= 1 - 0.08f * p.z;
    const fit::Binding binding = fit::bind(cone.geometry(), upright());
    for (double beta = 0; beta < 6; beta += 0.37) {
        const glm::dvec3 out(std::cos(beta), std::sin(beta), 0);
        const auto check = [&](const glm::dvec3& point, const glm::dvec3& toward) {
            const bend::Socket socket = fit::socket_near(binding, cone.geometry(), point);
            const glm::dvec3 normal = vector_of(socket.normal), tangent = vector_of(socket.tangent);
            REQUIRE(glm::length(tangent) == doctest::Approx(1));
            REQUIRE(std::abs(glm::dot(tangent, normal)) < 1e-9);
            // No direction in the plane points there more.
            REQUIRE(glm::dot(tangent, toward) ==
                    doctest::Approx(std::sqrt(1 - std::pow(glm::dot(normal, toward), 2))));
        };
        for (double z = 1; z < 10; z += 1.7) check(2.0 * out + glm::dvec3(0, 0, z), {0, 0, 1});
        for (const double z : {-1.0, 11.0}) check(0.1 * out + glm::dvec3(0, 0, z), {1, 0, 0});
    }
}

TEST_CASE("sockets: a surface without area has none") {
    const Solid solid = tube();
    const fit::Binding binding = fit::bind(solid.geometry(), upright());
    fit::Geometry flat = solid.geometry();
    flat.triangles = {};
    CHECK_THROWS_WITH_AS((void)fit::socket_near(binding, flat, {0, 0, 1}),
                         doctest::Contains("has no triangles"), fit::Error);
    const std::vector<std::uint32_t> slivers{0, 0, 4, 8, 8, 200, 400, 400, 700};
    flat.triangles = slivers;
    CHECK_THROWS_WITH_AS((void)fit::socket_near(binding, flat, {0, 0, 1}),
                         doctest::Contains("no triangle has an area"), fit::Error);
}
