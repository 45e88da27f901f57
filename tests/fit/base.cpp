// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/fit/base.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace goffer::test {
namespace {

using fit::Amplitude;
using fit::Profile;

constexpr double base_length = 10, base_radius = 1;

/// A mesh with rows for five folds, bound with `options`.
fit::Binding bound_with(const fit::BindOptions& options, double rest_angle = 0) {
    Random random(5);
    TestMesh mesh = random_mesh(random, base_length / base_radius, base_length, 24, 97, 0);
    mesh.cylinder.rest_angle = rest_angle;
    if (rest_angle != 0) {  // any mesh on the arc will do
        for (glm::vec3& position : mesh.positions)
            position = glm::vec3(mesh.cylinder.origin) +
                       0.05f * (position - glm::vec3(mesh.cylinder.origin)) +
                       0.3f * glm::vec3(mesh.cylinder.axis);
    }
    return fit::bind(mesh.geometry(), mesh.cylinder, options);
}

double change(const fit::BindOptions& options, const std::vector<double>& angles) {
    return fit::base_area_change(bound_with(options), angles).value();
}

}  // namespace

TEST_CASE("the bare base loses kappa, whichever way it is bent") {
    CHECK(change({.folds = 0}, {1.5}) == doctest::Approx(-0.15));
    CHECK(change({.folds = 0}, {-1.5}) == doctest::Approx(-0.15));
    CHECK(change({.folds = 4, .amplitude = Amplitude::none}, {1.5}) == doctest::Approx(-0.15));
    CHECK(change({.folds = 4}, {0}) == 0);
}

TEST_CASE("the wrinkled base has the area that its amplitude and its profile give it") {
    for (const Profile profile : {Profile::damped, Profile::smooth}) {
        const double paper = paper::lateral_area(profile, 4, base_length, base_radius, 1.5, 1) - 1;
        CHECK(std::fabs(paper) > 1e-4);
        CHECK(change({.folds = 4, .profile = profile}, {1.5}) == doctest::Approx(paper));
        CHECK(change({.folds = 4, .profile = profile}, {-1.5}) == doctest::Approx(paper));
        CHECK(change({.folds = 4, .amplitude = Amplitude::mesh, .profile = profile}, {1.5}) ==
              doctest::Approx(paper));
        CHECK(std::fabs(change({.folds = 4, .amplitude = Amplitude::area, .profile = profile}, {1.5})) <
              1e-6);
    }
}

TEST_CASE("regions' bases change by their shares of the length") {
    fit::BindOptions options = fit::BindOptions::as_in_paper();
    options.regions = {{0.4, 3}, {0.6, 0}};
    const double wrinkled =
        paper::lateral_area(Profile::damped, 3, 0.4 * base_length, base_radius, 0.9, 1) - 1;
    CHECK(change(options, {0.9, 1.2}) == doctest::Approx(0.4 * wrinkled - 0.6 * 1.2 / 6));
    CHECK_THROWS_AS((void)change(options, {0.9}), fit::Error);
}

TEST_CASE("of bases that are bent at rest or have an onset no area is said") {
    const std::vector<double> angles{1.0};
    CHECK_FALSE(fit::base_area_change(bound_with({.folds = 4, .onset = 0.1}), angles).has_value());
    CHECK_FALSE(fit::base_area_change(bound_with({.folds = 0}, 0.5), angles).has_value());
    CHECK(fit::base_area_change(bound_with({.folds = 0, .onset = 0.1}), angles).has_value());
}

TEST_CASE("a wrinkle is as deep as eq 7 says of the most squeezed column") {
    for (const Profile profile : {Profile::damped, Profile::even}) {
        fit::BindOptions options;
        options.profile = profile;
        options.regions = {{0.4, 3}, {0.6, 0}};
        const fit::Binding binding = bound_with(options);
        const double depth = profile.trough() * paper::amplitude(profile, 3, 0.4 * base_length,
                                                                 2 * 0.9 * base_radius / (0.4 * base_length));
        CHECK(depth > 0.1);
        CHECK(fit::wrinkle_depth(binding, 0, 0.9) == doctest::Approx(depth));
        CHECK(fit::wrinkle_depth(binding, 0, -0.9) == doctest::Approx(depth));
        CHECK(fit::wrinkle_depth(binding, 0, 0) == 0);
        CHECK(fit::wrinkle_depth(binding, 1, 0.9) == 0);
    }
}

TEST_CASE("a rest arc's center line lies a radius inside its outer line") {
    fit::Cylinder cylinder;
    cylinder.length = 6;
    cylinder.radius = 0.5;
    CHECK(std::isinf(fit::rest_radius(cylinder)));
    cylinder.rest_angle = 2;
    CHECK(fit::rest_radius(cylinder) == doctest::Approx(2.5));
}

}  // namespace goffer::test
