// SPDX-License-Identifier: MIT
#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace goffer::paper;

namespace {

// Eq 2-5 as the paper writes them: a circular arc about R0, which divides by alpha. In long double, so that
// the cancellation at small angles leaves enough digits to compare with.
glm::dvec3 eq_2_to_5(const Parameters& body, const Pose& pose, const Cylindrical& vertex, double wrinkle) {
    using Real = long double;
    const Real alpha = pose.angle, theta = pose.direction;
    // From R0 to the center line; the outer column keeps L.
    const Real to_axis = body.length / alpha - body.radius;
    const Real phi = alpha * vertex.z / body.length;
    const Real rho = Real{vertex.rho} + wrinkle;
    const Real x = rho * std::cos(Real{vertex.beta}), y = rho * std::sin(Real{vertex.beta});
    const Real toward = x * std::cos(theta) + y * std::sin(theta);
    const Real dist = -x * std::sin(theta) + y * std::cos(theta);  // erratum: signed
    const Real arm = to_axis - toward;                             // R0 to the vertex, in the bend plane
    const Real in_plane = to_axis - arm * std::cos(phi);
    return {static_cast<double>(in_plane * std::cos(theta) - dist * std::sin(theta)),
            static_cast<double>(in_plane * std::sin(theta) + dist * std::cos(theta)),
            static_cast<double>(arm * std::sin(phi))};
}

}  // namespace

TEST_CASE("the stable form is eq 2-5, wrinkled by eq 6-10") {
    std::mt19937 engine(7);
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    };
    for (const double angle : {1e-6, 1e-3, 0.1, 1.0, 3.0, 4.5}) {
        for (int i = 0; i < 100; ++i) {
            const Parameters body{10, 1, 1 + i % 7, i % 2 ? Profile::damped : Profile::smooth};
            const Pose pose{angle, in(-4, 4)};
            const Cylindrical v{in(-4, 4), in(0, 10), in(0.5, 1.5)};
            const double q = squeeze(angle * body.radius / body.length, v.beta, pose.direction);
            const double f = amplitude(body.profile, body.folds.count, body.length, q) *
                             shape(body.profile, body.folds.count, std::abs(2 * v.z / body.length - 1));
            const glm::dvec3 expected = eq_2_to_5(body, pose, v, f);
            CHECK(glm::length(ClosedForm(body, pose).position(v) - expected) < 1e-11);
        }
    }
}

TEST_CASE("toward the axis the wrinkle fades like the depth weight") {
    const Parameters body{10, 1, 3};
    const Pose pose{1, 0.2};
    const double q = squeeze(0.1, 1.0, 0.2);
    for (const double rho : {0.0, 0.1, 0.4, 0.5, 1.2}) {
        const double f =
            amplitude(body.profile, 3, 10, q) * shape(body.profile, 3, 0.5) * std::min(1.0, 2 * rho);
        CHECK(glm::length(ClosedForm(body, pose).position({1.0, 7.5, rho}) -
                          eq_2_to_5(body, pose, {1.0, 7.5, rho}, f)) < 1e-14);
    }
}
