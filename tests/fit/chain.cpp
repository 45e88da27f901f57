// SPDX-License-Identifier: MIT
#include "refusals.hpp"
#include "support/angles.hpp"
#include "support/bodies.hpp"
#include "support/rounds.hpp"
#include "support/says.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/paper/chain.hpp>
#include <goffer/paper/shape.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// Bodies that are bent at rest along a chain of arcs.

using namespace goffer;
using fit::Cylinder;
using fit::RestArc;
using test::degree;
using test::Recipe;
using test::says;
using test::Solid;

namespace {

using Arcs = std::vector<RestArc>;

double length_of(const Arcs& arcs) {
    double length = 0;
    for (const RestArc& arc : arcs) length += arc.length;
    return length;
}

/// Bends what is straight, of radius 1, along arcs.
class Bender {
public:
    explicit Bender(const Arcs& arcs) : arcs_(arcs), chain_(make(arcs)) {}

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& straight) const {
        paper::Cylindrical at = paper::to_cylindrical(straight);
        std::size_t region = 0;
        while (region + 1 < arcs_.size() && at.z > arcs_[region].length) at.z -= arcs_[region++].length;
        return chain_.position(region, at);
    }

private:
    static paper::Chain make(const Arcs& arcs) {
        std::vector<paper::Parameters> regions;
        std::vector<paper::Pose> poses;
        for (const RestArc& arc : arcs) {
            regions.push_back({.length = arc.length, .radius = 1});
            poses.push_back({arc.angle, arc.direction});
        }
        return paper::Chain(regions, poses);
    }

    Arcs arcs_;
    paper::Chain chain_;
};

Solid bent_along(const Arcs& arcs, Recipe recipe, std::mt19937& random) {
    recipe.length = length_of(arcs);
    return test::warped(test::cylinder(recipe, random), Bender(arcs));
}

Cylinder chain_of(const Solid& solid, std::optional<glm::dvec3> axis = std::nullopt) {
    return fit::fit_cylinder(solid.geometry(), axis, fit::RestPose::chain);
}

/// The largest distance of the truth's center line from that of the fit, both in model space, in radii.
double center_miss(const Cylinder& fitted, const Arcs& arcs, const test::Placing& placing) {
    constexpr int samples = 400;
    std::vector<fit::BasePoint> points;
    for (int i = 0; i <= samples; ++i) points.push_back({0, fitted.length * i / samples, 0});
    const std::vector<glm::dvec3> line = fit::places_on_base(fitted, points);
    const Bender bender(arcs);
    double most = 0;
    for (int i = 0; i <= 100; ++i) {
        const glm::dvec3 truth = placing(bender({0, 0, length_of(arcs) * i / 100}));
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
            const glm::dvec3 along = line[k + 1] - line[k];
            const double share =
                std::clamp(glm::dot(truth - line[k], along) / glm::dot(along, along), 0.0, 1.0);
            nearest = std::min(nearest, glm::length(truth - line[k] - share * along));
        }
        test::take_worst(most, nearest);
    }
    return most / placing.scale;
}

double bent_by(const Arcs& arcs) {
    double all = 0;
    for (const RestArc& arc : arcs) all += arc.angle;
    return all;
}

// A bent pipe, a cane, an S, and two bends in planes of their own.
const Arcs elbow{{8, 0, 0}, {4, 90 * degree, 0.4}, {8, 0, 0}};
const Arcs cane{{14, 0, 0}, {9, 180 * degree, 1}};
const Arcs s{{14, 160 * degree, -2}, {14, 160 * degree, -2 + std::numbers::pi}};
const Arcs twisted{{10, 80 * degree, 0}, {8, 0, 0}, {10, 80 * degree, 90 * degree}};

}  // namespace

TEST_CASE("chains: a body bent along arcs gets these arcs, however it lies and however fine it is") {
    std::mt19937 random(1);
    for (const Arcs& arcs : {elbow, cane, s, twisted}) {
        for (const Recipe& recipe : {Recipe{.rows = 96}, Recipe{.columns = 12, .rows = 60, .closed = false},
                                     Recipe{.columns = 20, .rows = 120, .dense = 3, .jitter = 0.3}}) {
            const test::Placing placing = test::random_placing(3, random);
            const Solid solid = test::placed(bent_along(arcs, recipe, random), placing);
            const Cylinder fitted = chain_of(solid);
            REQUIRE(fitted.arcs.size() >= 2);
            CHECK(fitted.arcs.size() <= arcs.size() + 2);
            CHECK(fitted.rest_angle == 0);
            CHECK(fitted.residual < 0.08);
            CHECK(center_miss(fitted, arcs, placing) < 0.06);
            CHECK(std::abs(bent_by(fitted.arcs) / bent_by(arcs) - 1) < 0.02);
            CHECK(std::abs(fitted.length / placing.scale / length_of(arcs) - 1) < 0.01);
            CHECK_NOTHROW(fit::check(fitted));
        }
    }
}

TEST_CASE("chains: a thin part and a thick one lie along the chain, each with its own radius") {
    std::mt19937 random(2);
    Solid solid = test::cylinder({.rows = 160, .length = length_of(s)}, random);
    const double length = length_of(s);
    for (glm::vec3& p : solid.positions) {
        const float thick = 1.2f - 0.7f * p.z / static_cast<float>(length);
        p.x *= thick, p.y *= thick;
    }
    solid = test::warped(std::move(solid), Bender(s));
    const Cylinder plain = chain_of(solid);
    REQUIRE(plain.arcs.size() >= 2);
    const Cylinder shaped = fit::fit_shape(solid.geometry(), plain);
    REQUIRE(!shaped.radii.empty());
    CHECK_NOTHROW(fit::check(shaped));
    CHECK(shaped.arcs.size() == plain.arcs.size());
    const auto [thinnest, thickest] = std::ranges::minmax(shaped.radii);
    CHECK(std::abs(thickest / 1.2 - 1) < 0.03);
    CHECK(std::abs(thinnest / 0.5 - 1) < 0.03);
    CHECK(std::abs(length_of(shaped.arcs) / shaped.length - 1) < 1e-9);
    CHECK(center_miss(shaped, s, {}) < 0.15);
    // And back, as ShapeMode::cylinder does.
    fit::BindOptions round;
    round.shape = fit::ShapeMode::cylinder;
    CHECK(center_miss(fit::bind(solid.geometry(), shaped, round).cylinder, s, {}) < 0.15);
}

TEST_CASE("chains: a clean tube gets one though it bends aside by less than its radius") {
    std::mt19937 random(14);
    const Arcs crook{{20, 0, 0}, {5, 60 * degree, 0.5}}, hook{{16, 0, 0}, {8, 90 * degree, 0}};
    const Arcs pipe{{8, 0, 0}, {8, 60 * degree, -1}, {8, 0, 0}};
    const Arcs slight{{12, 40 * degree, 1}, {12, 40 * degree, 1 + std::numbers::pi}};
    const Arcs uneven{{12, 40 * degree, 0}, {12, 80 * degree, std::numbers::pi}};
    for (const Arcs& arcs : {crook, hook, pipe, slight, uneven}) {
        CAPTURE(arcs[0].length);
        const test::Placing placing = test::random_placing(3, random);
        const Recipe recipe{.columns = 32, .rows = 160};
        const Cylinder fitted = chain_of(test::placed(bent_along(arcs, recipe, random), placing));
        REQUIRE(fitted.arcs.size() == arcs.size());
        CHECK(fitted.residual < 0.02);
        CHECK(center_miss(fitted, arcs, placing) < 0.03);
        CHECK(std::abs(bent_by(fitted.arcs) / bent_by(arcs) - 1) < 0.02);
    }
}

TEST_CASE("chains: a curled horn is followed to its thin end, and ends at its thick one") {
    std::mt19937 random(13);
    const Arcs curl{{16, 165 * degree, 0}, {16, 165 * degree, 0.3}};
    for (const float thinnest : {0.07f, 0.5f}) {
        CAPTURE(thinnest);
        for (const bool swapped : {false, true}) {
            Solid solid = test::cylinder({.rows = 240, .length = 32}, random);
            for (glm::vec3& p : solid.positions) {
                const float share = std::clamp(p.z / 32, 0.0f, 1.0f);
                p *= glm::vec3(glm::vec2(1 + (thinnest - 1) * (swapped ? 1 - share : share)), 1);
            }
            const test::Placing placing = test::random_placing(3, random);
            const Cylinder fitted =
                chain_of(test::placed(test::warped(std::move(solid), Bender(curl)), placing));
            REQUIRE(fitted.arcs.size() >= 2);
            CHECK(fitted.arcs.size() <= 4);
            CHECK(center_miss(fitted, curl, placing) < 0.06);
            CHECK(std::abs(bent_by(fitted.arcs) / bent_by(curl) - 1) < 0.02);
        }
    }
}

TEST_CASE("chains: a body that is far from round gets arcs where a line through it fits far worse") {
    std::mt19937 random(9);
    const auto is_chain = [&](const Arcs& arcs, float lobes) {
        Solid solid = test::cylinder({.rows = 160, .length = length_of(arcs)}, random);
        for (glm::vec3& p : solid.positions) {
            const float thick = 1 + lobes * std::cos(3 * std::atan2(p.y, p.x));
            p.x *= thick, p.y *= thick;
        }
        return chain_of(test::warped(std::move(solid), Bender(arcs))).arcs.size() >= 2;
    };
    const Arcs slight{{14, 80 * degree, -2}, {14, 80 * degree, -2 + std::numbers::pi}};
    const Arcs slender{{28, 120 * degree, -2}, {28, 120 * degree, -2 + std::numbers::pi}};
    CHECK(is_chain(s, 0.45f));        // 0.23 radii from round, and 0.41 of what it is about the line
    CHECK(!is_chain(s, 0.65f));       // 0.27 and 0.56
    CHECK(!is_chain(slight, 0.45f));  // 0.24 and 0.54
    CHECK(!is_chain(slender, 0.6f));  // 0.27 and 0.47
}

TEST_CASE("chains: a tip that points at the body's own side ends there") {
    std::mt19937 random(7);
    const Arcs hook{{24, 0, 0}, {18, 170 * degree, 0}, {7, 0, 0}, {5, 90 * degree, 0}, {4.5, 0, 0}};
    const Cylinder fitted = chain_of(bent_along(hook, {.rows = 240}, random));
    REQUIRE(fitted.arcs.size() >= 3);
    CHECK(std::abs(fitted.length / length_of(hook) - 1) < 0.03);
}

TEST_CASE("chains: a slender S is no arc of a wide ring") {
    std::mt19937 random(8);
    const Arcs slender{{400, 2, 0}, {400, 2, std::numbers::pi}};
    const Cylinder fitted = chain_of(bent_along(slender, {.columns = 12, .rows = 400}, random));
    CHECK(fitted.arcs.size() == 2);
    CHECK(std::abs(fitted.radius - 1) < 0.05);
}

TEST_CASE("chains: folds run on between arcs, unless one is bent as far as it can be") {
    const auto joined = [](const Cylinder& cylinder, std::optional<double> onset = {}) {
        fit::BindOptions options;
        options.onset = onset;
        return fit::bind(test::surface_of(cylinder).geometry(), cylinder, options).regions[0].blend != 0;
    };
    Cylinder cylinder;
    cylinder.length = 18;
    cylinder.radius = 1;
    // Halves of an arc whose radii are the same, differ by less than anyone sees, and more; and different
    // arcs.
    for (const double more : {0.0, 1e-9, 1e-3, 0.2}) {
        CAPTURE(more);
        cylinder.radii = {1 - more, 1 - more, 1, 1 + more, 1 + more};
        cylinder.arcs = {{9, 1.5, 0}, {9, 1.5, 0}};
        CHECK(joined(cylinder));
        cylinder.arcs[1] = {9, 1, 2};
        CHECK(joined(cylinder));
        CHECK(joined(cylinder, 0));
    }
    cylinder.radii.clear();
    // Without an onset, the squeezes of a straight region are not compared with those at rest.
    cylinder.arcs[1].angle = 0;
    CHECK(joined(cylinder));
    CHECK_FALSE(joined(cylinder, 0));
    cylinder.arcs[1].angle = 4.2;
    CHECK(joined(cylinder));
    cylinder.arcs[1].angle = 4.3;
    CHECK_FALSE(joined(cylinder));
    // A thin stretch that is bent that far, beside a thick one whose folds would reach into it.
    cylinder.radii = {1.3, 1.3, 1.3, 1.3, 0.7, 0.7, 0.7, 0.7};
    cylinder.arcs[1].angle = 4;
    CHECK(joined(cylinder));
    cylinder.arcs[1].angle = 4.2;
    CHECK_FALSE(joined(cylinder));
}

TEST_CASE("chains: there are as many arcs as are asked for") {
    std::mt19937 random(11);
    const auto with = [](const Solid& solid, std::size_t count, std::optional<glm::dvec3> axis = {}) {
        return fit::fit_cylinder(solid.geometry(), axis, fit::RestPose::chain, count);
    };
    for (const Arcs& arcs : {elbow, cane, s, twisted}) {
        const Solid solid = bent_along(arcs, {.rows = 96}, random);
        const Cylinder found = chain_of(solid);
        for (std::size_t count = found.arcs.size(); count <= 12; ++count) {
            CAPTURE(count);
            const Cylinder fitted = with(solid, count);
            CHECK(fitted.arcs.size() == count);
            CHECK(fitted.residual < 0.08);
            CHECK(center_miss(fitted, arcs, {}) < 0.08);
            CHECK(std::abs(fitted.length / length_of(arcs) - 1) < 0.01);
            CHECK_NOTHROW(fit::check(fitted));
            CHECK(fitted.origin == found.origin);  // it is the same chain
        }
    }
    const Solid spiral = bent_along({{9, 1, 0}, {9, 2, 1}, {9, 1, 3}, {9, 2, 5}}, {.rows = 128}, random);
    REQUIRE(chain_of(spiral).arcs.size() >= 4);
    CHECK(with(spiral, 3).arcs.size() == 3);  // not as closely
    const Solid straight = test::cylinder({.rows = 64, .length = 16}, random);
    CHECK(with(straight, 32).arcs.size() == 32);
    const Cylinder cut = with(straight, 5);
    CHECK(cut.arcs.size() == 5);
    CHECK(bent_by(cut.arcs) < 0.05);
    CHECK(std::abs(cut.length / 16 - 1) < 0.01);

    // Those of a body that few do not follow, or that has no room for so many.
    const auto said_of = [&](auto&& fit) { return test::error_of([&] { (void)fit(); }); };
    const Solid stout = test::cylinder({.length = 4}, random), bent = bent_along(cane, {.rows = 96}, random);
    CHECK(says(said_of([&] { return with(stout, 9); }),
               "does not follow a chain of 9, nor of more; give none"));
    CHECK(says(said_of([&] { return with(bent, 3, {{1, -1, 0}}); }), "3 along that axis"));
    CHECK(says(said_of([&] { return with(straight, 1); }), "arcs: 1 is outside 2..32"));
    CHECK(says(said_of([&] { return with(straight, 33); }), "arcs: 33 is outside"));
    CHECK(
        says(said_of([&] { return fit::fit_cylinder(straight.geometry(), {}, fit::RestPose::automatic, 3); }),
             "RestPose::chain"));
}

TEST_CASE("chains: folds may be said for each arc") {
    std::mt19937 random(12);
    const Solid solid = bent_along(elbow, {.rows = 160}, random);
    const Cylinder fitted = fit::fit_cylinder(solid.geometry(), {}, fit::RestPose::chain, 3);
    fit::BindOptions options;
    options.regions = {{0.9, 4}, {0.9, {}}, {0.9, 6}};
    options.folds = 10;
    const fit::Binding binding = fit::bind(solid.geometry(), fitted, options);
    REQUIRE(binding.regions.size() == 3);
    CHECK(binding.folds(0) == 4);
    CHECK(binding.folds(1) ==
          std::lround(10 * (fitted.arcs[0].length + fitted.arcs[1].length) / fitted.length) -
              std::lround(10 * fitted.arcs[0].length / fitted.length));
    CHECK(binding.folds(2) == 6);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(binding.regions[i].length == doctest::Approx(fitted.arcs[i].length).epsilon(1e-12));
}

TEST_CASE("chains: a ring gets none, nor does a wavy relief") {
    std::mt19937 random(10);
    const paper::ClosedForm ring({.length = 60, .radius = 1}, {6.2, 0});
    const Solid closed = test::warped(test::cylinder({.rows = 200, .length = 60, .closed = false}, random),
                                      [&](glm::dvec3 p) { return ring.position(paper::to_cylindrical(p)); });
    CHECK_THROWS_AS((void)chain_of(closed), fit::AxisError);
    Solid wavy = test::cylinder({.rows = 200, .length = 30}, random);
    Solid winding = wavy;
    for (glm::vec3& p : wavy.positions) p.x += 0.1f * std::sin(0.6f * p.z);
    for (glm::vec3& p : winding.positions) p.x += 0.6f * std::sin(0.6f * p.z);
    CHECK(chain_of(wavy).arcs.empty());
    CHECK(chain_of(winding).arcs.size() == 6);  // the halves of three waves: a clean tube
}

TEST_CASE("chains: bodies that are straight, or bent along one arc, get no chain") {
    std::mt19937 random(3);
    const paper::ClosedForm arc({.length = 12, .radius = 1}, {2, 1});
    for (int trial = 0; trial < test::rounds(24, 6); ++trial) {
        const Recipe recipe{.rows = 64, .length = 12, .noise = trial % 2 == 0 ? 0 : 0.03};
        const Solid straight = test::cylinder(recipe, random);
        CHECK(chain_of(straight).arcs.empty());
        const Solid bent =
            test::warped(straight, [&](glm::dvec3 p) { return arc.position(paper::to_cylindrical(p)); });
        const Cylinder fitted = chain_of(bent);
        CHECK(fitted.arcs.empty());
        CHECK(std::abs(fitted.rest_angle - 2) < 0.02);
        // A body of two thicknesses, and a flat one.
        Solid stepped = straight, flat = straight;
        for (glm::vec3& p : stepped.positions)
            if (p.z > 6) p.x *= 0.4f, p.y *= 0.4f;
        for (glm::vec3& p : flat.positions) p.x *= 0.3f;
        CHECK(chain_of(stepped).arcs.empty());
        CHECK(chain_of(flat).arcs.empty());
    }
    const Solid pipe = bent_along(elbow, {.rows = 96}, random);
    CHECK(test::fit_to(pipe).arcs.empty());  // nobody asked for one
}

TEST_CASE("chains: a given axis says which end is the base") {
    std::mt19937 random(4);
    const Solid solid = bent_along(elbow, {.rows = 96}, random);
    const glm::dvec3 chord = Bender(elbow)({0, 0, length_of(elbow)});
    const Cylinder there = chain_of(solid, chord), back = chain_of(solid, -chord);
    REQUIRE(there.arcs.size() == 3);
    REQUIRE(back.arcs.size() == 3);
    CHECK(glm::length(there.origin) < 0.1);
    CHECK(glm::length(back.origin - chord) < 0.1);
    CHECK(std::abs(there.arcs[1].angle - back.arcs[1].angle) < 0.01);
}

TEST_CASE(
    "chains: a body has a region for each arc, is the mesh at rest, and straight where all angles are 0") {
    std::mt19937 random(5);
    const Solid solid = bent_along(elbow, {.rows = 160}, random);
    const Cylinder fitted = chain_of(solid);
    const fit::Binding binding = fit::bind(solid.geometry(), fitted);
    const bend::Body& body = binding.body;
    REQUIRE(body.region_count() == fitted.arcs.size());
    test::Output out(body.vertex_count());
    const std::vector<bend::Pose> rest = body.rest_poses(), straight(body.region_count());
    bend::DeformJob job = test::make_job(body, bend::Pose{}, Isa::automatic, out);
    job.poses = rest;
    bend::run(job);
    const std::vector<std::uint32_t> places = binding.vertices_in_body();
    for (std::size_t i = 0; i < places.size(); ++i)
        REQUIRE(glm::length(out.position(places[i]) - glm::dvec3(solid.positions[i])) < 2e-5);
    job.poses = straight;
    bend::run(job);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 p = out.position(i) - fitted.origin;
        const double z = glm::dot(p, fitted.axis);
        REQUIRE(glm::length(p - z * fitted.axis) < 1.1);
        REQUIRE(z > -0.1);
        REQUIRE(z < fitted.length + 0.1);
    }
}

TEST_CASE("chains: places on the base have the heights that they were made with") {
    Cylinder cylinder;
    cylinder.length = length_of(twisted);
    cylinder.radius = 1;
    cylinder.arcs = twisted;
    std::vector<fit::BasePoint> points;
    for (int i = 0; i <= 300; ++i) points.push_back({0.7 * i, cylinder.length * i / 300, 0.3 + 0.002 * i});
    for (const bool shaped : {false, true}) {
        if (shaped) cylinder.radii = {1.3, 1.2, 1.0, 0.8, 0.7};
        std::vector<glm::vec3> positions;
        for (const glm::dvec3& place : fit::places_on_base(cylinder, points)) positions.emplace_back(place);
        const std::vector<double> heights = fit::heights(positions, cylinder);
        for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(std::abs(heights[i] - points[i].z) < 1e-5);
    }
}

TEST_CASE("chains: what makes none is named") {
    const auto said_of = [](auto&& spoil) {
        Cylinder cylinder;
        cylinder.length = length_of(elbow);
        cylinder.radius = 1;
        cylinder.arcs = elbow;
        spoil(cylinder);
        return test::error_of([&] { fit::check(cylinder); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(said_of([](Cylinder&) {}) == "");
    CHECK(says(said_of([](Cylinder& c) { c.length += 0.1; }), "add up to 20"));
    CHECK(says(said_of([](Cylinder& c) { c.rest_angle = 0.1; }), "give one of them"));
    CHECK(says(said_of([](Cylinder& c) { c.arcs[1].angle = 2.1; }), "0..2"));
    CHECK(says(said_of([](Cylinder& c) { c.arcs[1].angle = -0.1; }), "0..2"));
    CHECK(says(said_of([&](Cylinder& c) { c.arcs[0].angle = nan; }), "not finite"));
    CHECK(says(said_of([&](Cylinder& c) { c.arcs[2].direction = nan; }), "not finite"));
    CHECK(says(said_of([](Cylinder& c) { c.arcs[0].length = 0; }), "length of one of the arcs"));
    CHECK(says(said_of([](Cylinder& c) { c.arcs.assign(33, {c.length / 33, 0, 0}); }), "33 arcs"));
    CHECK(said_of([](Cylinder& c) { c.arcs.assign(32, {c.length / 32, 0, 0}); }) == "");
    CHECK(says(said_of([](Cylinder& c) {
                   c.radii = {0.2, 2.6, 0.2};
                   c.radius = paper::Spline(c.length, c.radii).mean();
               }),
               "largest radius"));
    std::mt19937 random(6);
    const Solid solid = bent_along(elbow, {.rows = 96}, random);
    fit::BindOptions options;
    options.regions = {{0.5, {}}, {0.5, {}}};
    CHECK_THROWS_WITH_AS((void)fit::bind(solid.geometry(), chain_of(solid), options),
                         doctest::Contains("give none"), fit::Error);
    options.regions.clear();
    options.amplitude = paper::Amplitude::area;
    CHECK_THROWS_WITH_AS((void)fit::bind(solid.geometry(), chain_of(solid), options),
                         doctest::Contains("bent at rest"), fit::Error);
}
