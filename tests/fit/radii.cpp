// SPDX-License-Identifier: MIT
#include "support/models.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/patches.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/paper/closed_form.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

/// Bodies that are thicker here than there: their radii, their folds, and what these do to the area.

using namespace goffer;
using test::Solid;

namespace {

/// A tube whose radius goes from `low` to `high`.
Solid tapered_tube(double low, double high, int rows = 96) {
    std::mt19937 random(1);
    Solid solid = test::cylinder({.columns = 40, .rows = rows}, random);
    for (glm::vec3& p : solid.positions) {
        const float radius = static_cast<float>(low + (high - low) * static_cast<double>(p.z) / 10);
        p.x *= radius;
        p.y *= radius;
    }
    return solid;
}

std::vector<glm::vec3> bent_to(const fit::Binding& binding, const bend::Pose& pose) {
    std::vector<glm::vec3> positions(binding.body.vertex_count());
    bend::DeformJob job;
    job.body = &binding.body;
    job.pose = pose;
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    return positions;
}

fit::Cylinder shaped(const Solid& solid) {
    return fit::fit_shape(solid.geometry(), fit::fit_cylinder(solid.geometry()));
}

/// The deepest fold over the radius where it stands, on the inner side of a body that is bent by 90 degrees.
double deepest(const fit::Binding& binding) {
    const auto& shape = binding.regions[0].shape;
    const paper::Parameters body{binding.regions[0].length,
                                 shape ? shape->radius() : binding.cylinder.radius,
                                 binding.folds(),
                                 binding.profile,
                                 paper::Amplitude::paper,
                                 0,
                                 0,
                                 0,
                                 shape};
    paper::Parameters bare = body;
    bare.folds = 0;
    const paper::Pose pose{std::numbers::pi / 2, 0};
    const paper::ClosedForm wrinkled(body, pose), smooth(bare, pose);
    double most = 0;
    for (int i = 0; i <= 2000; ++i) {
        const double z = body.length * i / 2000, rho = body.radius * (shape ? shape->scale(z) : 1);
        const paper::Cylindrical at{0, z, rho};
        test::take_worst(most, glm::length(wrinkled.position(at) - smooth.position(at)) / rho);
    }
    return most;
}

}  // namespace

TEST_CASE("radii: a cylinder has none, a cone's go from one end's to the other's") {
    std::mt19937 random(2);
    CHECK(shaped(test::cylinder({}, random)).radii.empty());
    CHECK(shaped(test::cylinder({.noise = 0.02}, random)).radii.empty());
    for (const auto& [low, high] : {std::pair{1.4, 0.3}, {0.5, 1.0}}) {
        const Solid cone = tapered_tube(low, high);
        const fit::Cylinder found =
            fit::fit_shape(cone.geometry(), fit::fit_cylinder(cone.geometry(), {{0, 0, 1}}));
        REQUIRE(found.radii.size() > 4);
        CHECK(found.radius == doctest::Approx((low + high) / 2).epsilon(0.02));
        const paper::Spline radii(found.length, found.radii);
        for (const double z : {1.0, 3.0, 5.0, 7.0, 9.0})
            CHECK(radii(z) == doctest::Approx(low + (high - low) * z / 10).epsilon(0.02));
        CHECK_NOTHROW(fit::check(found));
    }
}

TEST_CASE("radii: they follow scale and rotation, and do not ask how finely parts are cut") {
    std::mt19937 random(3);
    const Solid cone = tapered_tube(1.2, 0.5);
    const fit::Cylinder here = shaped(cone);
    for (int trial = 0; trial < 5; ++trial) {
        const test::Placing placing = test::random_placing(3, random);
        const fit::Cylinder there = shaped(test::scrambled(test::placed(cone, placing)));
        CHECK(there.radius == doctest::Approx(placing.scale * here.radius).epsilon(1e-3));
    }
    const fit::Cylinder coarse = shaped(tapered_tube(1.2, 0.5, 4));
    CHECK(coarse.radius == doctest::Approx(here.radius).epsilon(0.01));
}

TEST_CASE("radii: a body that is bent at rest gets its shape back (P1)") {
    const auto shape =
        std::make_shared<const paper::Shape>(10.0, 1.0, paper::Shape::Knots{.radius = {1.2, 0.5}});
    paper::Parameters cone{10, shape->radius(), 0};
    cone.shape = shape;
    const paper::ClosedForm arc(cone, {1.2, 0.4});
    Solid solid = tapered_tube(1.2, 0.5);
    for (glm::vec3& p : solid.positions) p = arc.position(paper::to_cylindrical(glm::dvec3(p)));
    const fit::Cylinder fitted = fit::fit_cylinder(solid.geometry(), {{0, 0, 1}});
    CHECK(fitted.rest_angle > 0.8);
    const fit::Binding binding = fit::bind(solid.geometry(), fitted);
    REQUIRE(!binding.cylinder.radii.empty());
    const std::vector<glm::vec3> back = bent_to(binding, binding.body.rest_pose());
    double worst = 0;
    for (std::size_t i = 0; i < back.size(); ++i)
        test::take_worst(worst, glm::length(glm::dvec3(back[i]) - glm::dvec3(solid.positions[i])));
    CHECK(worst < 1e-6 * 10);
    // The center line is the one that was fitted.
    CHECK(fit::rest_radius(binding.cylinder) == doctest::Approx(fit::rest_radius(fitted)).epsilon(1e-9));
}

TEST_CASE("radii: a body that is too thick for its own arc keeps one radius") {
    const paper::ClosedForm arc({10, 1, 0}, {2.8, 0.4});
    const Solid barrel = test::warped(test::tube(), [](glm::dvec3 p) {
        const double rho = 0.4 + 1.6 * std::pow(std::sin(std::numbers::pi * p.z / 10), 4);
        return glm::dvec3(rho * p.x, rho * p.y, p.z);
    });
    fit::Cylinder base = test::upright();
    base.rest_angle = 2.8;
    base.rest_direction = 0.4;
    for (const double thinner : {1.0, 0.6}) {
        const Solid solid = test::warped(barrel, [&](glm::dvec3 p) {
            return arc.position(paper::to_cylindrical({thinner * p.x, thinner * p.y, p.z}));
        });
        const fit::Cylinder found = fit::fit_shape(solid.geometry(), base);
        CHECK(found.radii.empty() == (thinner == 1));
        CHECK((found.radius == base.radius) == (thinner == 1));
        CHECK((found.length == base.length) == (thinner == 1));
        CHECK_NOTHROW(fit::check(found));
    }
}

TEST_CASE("radii: a body that is bent at rest as far as it can be is bound") {
    fit::Cylinder base = test::upright();
    base.radii = {1.2, 1.1, 1, 0.9, 0.8};
    const double most = base.length / (2 * 1.2);
    for (const double share : {0.97, 0.9985, 0.9995, 0.9998}) {
        CAPTURE(share);
        base.rest_angle = share * most;
        const Solid solid = test::surface_of(base);
        const fit::Binding binding = fit::bind(solid.geometry(), base);
        const std::vector<glm::vec3> back = bent_to(binding, binding.body.rest_pose());
        double worst = 0;
        for (std::size_t i = 0; i < back.size(); ++i)
            test::take_worst(worst, glm::length(glm::dvec3(back[i]) - glm::dvec3(solid.positions[i])));
        CHECK(worst < 1e-5 * 10);
    }
}

TEST_CASE("radii: a knot in a stalk may be as narrow as radii are apart") {
    std::mt19937 random(5);
    const test::Solid solid = test::cylinder({.columns = 12, .rows = 800}, random);
    fit::Cylinder base = test::upright();
    base.radii.assign(124, 1);
    base.radii[55] = 3;
    base.radius = paper::Spline(base.length, base.radii).mean();
    const fit::Binding binding = fit::bind(solid.geometry(), base);
    const double most = 1 + 2 * 2.0 / 3;  // the spline's weight at its knot
    CHECK(binding.body.region_inputs()[0].max_scale * base.radius > most);
}

TEST_CASE("folds: as long and as deep as the body is thick") {
    const Solid cone = tapered_tube(1.4, 0.5, 800);
    const fit::Binding binding = fit::bind(cone.geometry(), shaped(cone));
    const auto& shape = binding.regions[0].shape;
    REQUIRE(shape);
    CHECK(binding.folds() == doctest::Approx(10 / 0.5 * std::log(1.4 / 0.5) / 0.9).epsilon(0.06));
    CHECK(deepest(binding) < 0.25);
    fit::BindOptions options;
    options.fold_length = 0.25;
    CHECK(deepest(fit::bind(cone.geometry(), shaped(cone), options)) ==
          doctest::Approx(deepest(binding) / 2).epsilon(0.1));
    CHECK(deepest(fit::bind(cone.geometry(), shaped(cone), fit::BindOptions::as_in_paper())) > 0.3);
}

TEST_CASE("folds: a stout body has a dozen, as its suitable folds say") {
    std::mt19937 random(4);
    for (const auto& [length, count] : {std::pair(4.0, 12), std::pair(5.9, 12), std::pair(8.0, 16)}) {
        const Solid tube = test::cylinder({.rows = 320, .length = length}, random);
        const fit::Cylinder base = fit::fit_cylinder(tube.geometry(), {{0, 0, 1}});
        const fit::Binding binding = fit::bind(tube.geometry(), base);
        CHECK(binding.folds() == count);
        CHECK(fit::suitable_folds(binding.cylinder, {}) == std::vector{count});
        CHECK(deepest(binding) < 0.25);
        fit::BindOptions options;
        options.fold_length = 0.5;  // is what it says
        CHECK(fit::bind(tube.geometry(), base, options).folds() == std::lround(2 * length));
    }
}

TEST_CASE("folds: a mesh carries as many as its rows allow, and none where they would be too long") {
    std::mt19937 random(4);
    const auto folds = [&](int rows) {
        const Solid tube = test::cylinder({.rows = rows}, random);
        return fit::bind(tube.geometry(), fit::fit_cylinder(tube.geometry()));
    };
    CHECK(folds(320).folds() == 20);  // of half a radius
    CHECK(folds(64).folds() == 8);    // of eight rows
    CHECK(deepest(folds(64)) < 0.35);
    CHECK(folds(24).folds() == 0);  // eight rows are 3.3 radii
    CHECK(folds(33).folds() == 0);  // of which nobody would see a hundredth of their depth
    CHECK(folds(37).folds() == 5);
    // Fine up to the middle, coarse from there on.
    Solid both = test::cylinder({.rows = 160}, random);
    for (glm::vec3& p : both.positions) {
        const float row = p.z * 16;
        p.z = row < 150 ? row * (5.0f / 150) : p.z < 10 ? 5 + (row - 150) * 0.5f : 10;
    }
    const fit::Binding binding = fit::bind(both.geometry(), fit::fit_cylinder(both.geometry()));
    REQUIRE(binding.regions[0].shape);
    CHECK(binding.folds() > 4);
    CHECK(binding.regions[0].shape->depth(2) > 0.5);
    CHECK(binding.regions[0].shape->depth(8) < 1e-3);
}

TEST_CASE("local area: folds of the body's own size keep it several times better than the paper's") {
    const auto rms = [](const mesh::VertexArrays& read, const fit::Cylinder& cylinder,
                        const fit::BindOptions& options) {
        const fit::Geometry before{read.positions, read.triangles};
        const fit::Refinement refinement =
            fit::refine(before, cylinder, fit::stretches_of(cylinder, options));
        const std::vector<glm::vec3> positions = fit::refined_positions(read.positions, refinement);
        const fit::Geometry geometry{positions, refinement.triangles};
        const fit::Binding binding = fit::bind(geometry, cylinder, options);
        const std::vector<std::uint32_t> patches = fit::patches_of(geometry, cylinder);
        double sum = 0;
        for (const float direction : {0.0f, 1.5f, 3.0f, 4.5f}) {
            const std::vector<glm::vec3> after = bent_to(binding, {std::numbers::pi_v<float> / 2, direction});
            sum += fit::patch_change(geometry, after, patches).rms / 4;
        }
        return sum;
    };
    fit::BindOptions own;
    own.amplitude = fit::Amplitude::mesh;
    for (const char* name : {"wine_bottle.glb", "fuze.ply", "log_01.glb"}) {
        const std::filesystem::path path = test::model(name);
        if (path.empty()) continue;
        const mesh::VertexArrays read = mesh::vertex_arrays(mesh::load(path));
        const fit::Geometry geometry{read.positions, read.triangles};
        const fit::Cylinder cylinder = fit::fit_cylinder(geometry, std::nullopt, fit::RestPose::straight);
        const double paper = rms(read, cylinder, fit::BindOptions::as_in_paper());
        const double here = rms(read, fit::fit_shape(geometry, cylinder), own);
        std::printf("%-16s local area at 90 deg: paper %.1f %%, own %.1f %%\n", name, 100 * paper,
                    100 * here);
        CHECK(here < 0.45 * paper);
    }
}
