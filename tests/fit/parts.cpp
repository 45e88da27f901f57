// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/base.hpp>
#include <goffer/fit/bind.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// Parts of a body that are too thin for its wrinkles.

namespace goffer {
namespace {

constexpr int ring_columns = 24, ring_rows = 400;
constexpr double tube_length = 10;

/// Tubes beside another.
struct Rods {
    double radius, distance;  ///< of their middles from the axis
    double flatness = 1;      ///< their thickness around the body over that away from it
    int count = 1;
    double apart = 0.2;  ///< radians
};

/// A tube of radius 1 and, for 6 of its length, others beside it.
test::Solid tube_and_rods(const Rods& rods) {
    std::mt19937 random(5);
    test::Recipe recipe{.columns = ring_columns, .rows = ring_rows, .length = tube_length};
    test::Solid solid = test::cylinder(recipe, random);
    recipe.length = 6;
    const test::Solid rod = test::cylinder(recipe, random);
    for (int i = 0; i < rods.count; ++i) {
        const auto before = static_cast<std::uint32_t>(solid.positions.size());
        const double c = std::cos(i * rods.apart), s = std::sin(i * rods.apart);
        for (const glm::vec3& p : rod.positions) {
            const double x = rods.radius * p.x + rods.distance, y = rods.flatness * rods.radius * p.y;
            solid.positions.emplace_back(c * x - s * y, s * x + c * y, p.z + 2);
        }
        for (const std::uint32_t vertex : rod.triangles) solid.triangles.push_back(before + vertex);
    }
    return solid;
}

test::Solid tube_and_rod(double rod_radius, double distance) {
    return tube_and_rods({rod_radius, distance});
}

test::Solid turned_about_axis(test::Solid solid, double turn) {
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    for (glm::vec3& p : solid.positions) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    return solid;
}

fit::Cylinder base_of_tube() {
    fit::Cylinder base = test::upright();
    base.length = tube_length;
    return base;
}

/// How far wrinkles move the centers of rings of vertices at most, bent by a right angle: of the tube, and of
/// the rod.
struct Wobble {
    double tube = 0, rod = 0;
};

Wobble wobble_of(const test::Solid& solid, const fit::Binding& binding) {
    Wobble most;
    for (const float direction : {0.0f, 1.5f, 3.14f}) {
        std::vector<glm::vec3> wrinkled(solid.positions.size()), bare(wrinkled.size());
        bend::DeformJob job{.body = &binding.body, .pose = {std::numbers::pi_v<float> / 2, direction}};
        job.positions = interleaved<3>(&wrinkled[0].x, wrinkled.size());
        bend::run(job);
        job.wrinkle_weight = 0;
        job.positions = interleaved<3>(&bare[0].x, bare.size());
        bend::run(job);
        for (std::size_t row = 0; row < std::size_t{2} * (ring_rows + 1); ++row) {
            glm::dvec3 moved(0);
            for (std::size_t i = row * ring_columns; i < (row + 1) * ring_columns; ++i)
                moved += glm::dvec3(wrinkled[i] - bare[i]) / double{ring_columns};
            double& own = row < ring_rows + 1 ? most.tube : most.rod;
            own = std::max(own, glm::length(moved));
        }
    }
    return most;
}

}  // namespace

TEST_CASE("parts: a thin rod beside the body hardly wobbles, and the body wrinkles as it does alone") {
    constexpr double radius = 0.15;
    const test::Solid solid = tube_and_rod(radius, 1.5);
    fit::BindOptions options;
    const fit::Cylinder base = base_of_tube();
    const Wobble own = wobble_of(solid, fit::bind(solid.geometry(), base, options));
    options.shape = fit::ShapeMode::cylinder;
    const Wobble whole = wobble_of(solid, fit::bind(solid.geometry(), base, options));
    MESSAGE("rod ", own.rod / radius, " of its radius instead of ", whole.rod / radius, "; body ", own.tube,
            " and ", whole.tube);
    CHECK(whole.rod > 0.5 * radius);
    CHECK(own.rod < 0.1 * radius);
    CHECK(own.tube < 0.1);
    CHECK(own.tube > 0.8 * whole.tube);
}

TEST_CASE("parts: a body that is one tube bears all of its wrinkles") {
    std::mt19937 random(6);
    const test::Solid solid = test::cylinder({.columns = 24, .rows = 200}, random);
    fit::Parts parts(solid.geometry(), test::upright());
    const auto depth = [](double) { return 0.2; };
    parts.weigh(depth, depth);
    CHECK(parts.sound());
    CHECK(parts.at({0.3, 4, 1}).value == 1);
}

TEST_CASE("parts: deeper wrinkles weigh less, and weights change along the body as their slopes say") {
    constexpr double distance = 2.5;
    const test::Solid solid = tube_and_rod(0.15, distance);
    fit::Parts parts(solid.geometry(), base_of_tube());
    double last = 1;
    for (const double depth : {0.05, 0.1, 0.2, 0.4}) {
        const auto deep = [depth](double) { return depth; };
        parts.weigh(deep, deep);
        CHECK_FALSE(parts.sound());
        const double far = parts.at({0, 5, distance + 0.15}).value;
        const double near = parts.at({0, 5, distance - 0.15}).value;
        CHECK(far > 0);
        CHECK(far <= last);
        CHECK(near < 0);  // away from the rod's own center is toward the axis
        last = far;
        for (double z = 0.3; z < 9.8; z += 0.37) {
            constexpr double step = 1e-5;
            const auto value = [&](double up) { return parts.at({0.05, z + up, distance + 0.12}).value; };
            const double slope = (value(step) - value(-step)) / (2 * step);
            CHECK(parts.at({0.05, z, distance + 0.12}).slope ==
                  doctest::Approx(slope).epsilon(1e-4).scale(1));
        }
        CHECK(parts.at({std::numbers::pi, 5, 1}).value > 0.97);  // the tube's other side
    }
}

TEST_CASE("parts: a wrinkle moves nothing through what lies farther out") {
    constexpr double most = 1;  // of a distance, by which the deepest wrinkle may shorten it
    std::mt19937 random(7);
    std::uniform_real_distribution<double> height(0, tube_length), angle(-0.6, 0.6), away(0.5, 3),
        part(0.01, 0.3);
    double worst = 0;
    for (const double radius : {0.03, 0.15, 0.4, 0.9}) {
        for (const double gap : {0.01, 0.1, 0.3}) {
            const test::Solid solid = tube_and_rod(radius, 1 + gap + radius);
            fit::Parts parts(solid.geometry(), base_of_tube());
            constexpr double depth = 0.23;
            const auto deep = [](double) { return depth; };
            parts.weigh(deep, deep);
            for (int i = 0; i < 2000; ++i) {
                const double beta = angle(random), z = height(random), rho = away(random),
                             step = part(random);
                const auto moved = [&](double at) {
                    return depth * parts.at({beta, z, at}).value * paper::depth_weight(at, 1);
                };
                test::take_worst(worst, std::fabs(moved(rho + step) - moved(rho)) / step);
            }
        }
    }
    MESSAGE("a distance becomes shorter by ", worst, " of it at most");
    CHECK(worst < most);
    CHECK(worst > 0.3);  // they do differ
}

TEST_CASE("parts: a plate is as thin as it is, however wide, and stands almost still") {
    const auto deep = [](double) { return 0.2; };
    const auto weight = [&](double flatness) {
        const test::Solid solid = tube_and_rods({.radius = 0.6, .distance = 2.5, .flatness = flatness});
        fit::Parts parts(solid.geometry(), base_of_tube());
        parts.weigh(deep, deep);
        return parts.at({0, 5, 3.05}).value;
    };
    CHECK(weight(1) > 0.5);
    CHECK(weight(0.05) < 0.3);
}

TEST_CASE("parts: a thin part close to a thick one hardly sways either") {
    const auto deep = [](double) { return 0.2; };
    const auto weights = [&](const Rods& rods) {  // on its outer line, its inner line, and the tube below it
        const test::Solid solid = tube_and_rods(rods);
        fit::Parts parts(solid.geometry(), base_of_tube());
        parts.weigh(deep, deep);
        return std::array{parts.at({0, 5, rods.distance + rods.radius}).value,
                          parts.at({0, 5, rods.distance - rods.radius}).value, parts.at({0, 5, 1}).value};
    };
    const auto far = weights({.radius = 0.3, .distance = 2.5});
    const auto close = weights({.radius = 0.3, .distance = 1.35});
    CHECK(std::fabs(close[0]) < 1.1 * std::fabs(far[0]));
    CHECK(close[1] < 0.4 * far[1]);  // away from the rod's own center
    // What lies on the tube goes with it.
    const auto grip = weights({.radius = 0.02, .distance = 1.03, .flatness = 12});
    CHECK(grip[0] > 0.6);
    CHECK(grip[2] > 0.6);
}

TEST_CASE("parts: hairs in number do not make the body between them smooth") {
    const test::Solid solid = tube_and_rods({.radius = 0.02, .distance = 1.05, .count = 16, .apart = 0.1});
    fit::Parts parts(solid.geometry(), base_of_tube());
    const auto deep = [](double) { return 0.2; };
    parts.weigh(deep, deep);
    CHECK_FALSE(parts.sound());
    for (double beta = 0; beta < 1.5; beta += 0.05) CHECK(parts.at({beta, 5, 1}).value > 0.8);
}

TEST_CASE("parts: a fin stands almost still, and the body that it stands on wrinkles") {
    for (const double thickness : {0.002, 0.02}) {
        CAPTURE(thickness);
        const test::Solid solid =
            tube_and_rods({.radius = 0.55, .distance = 1.6, .flatness = thickness / 0.55});
        fit::Parts parts(solid.geometry(), base_of_tube());
        const auto deep = [](double) { return 0.2; };
        parts.weigh(deep, deep);
        CHECK(parts.at({0, 5, 2.1}).value < 0.3);
        for (double beta = 0.5; beta < 3; beta += 0.1) CHECK(parts.at({beta, 5, 1}).value > 0.7);
    }
}

TEST_CASE("parts: what is turned about the axis has the same weights, turned") {
    const test::Solid solid = tube_and_rod(0.15, 2.5);
    const auto deep = [](double) { return 0.2; };
    fit::Parts parts(solid.geometry(), base_of_tube());
    parts.weigh(deep, deep);
    for (const double turn : {0.4, std::numbers::pi / 2, 2.8}) {
        const test::Solid turned = turned_about_axis(solid, turn);
        fit::Parts other(turned.geometry(), base_of_tube());
        other.weigh(deep, deep);
        double worst = 0;
        for (double beta = 0; beta < 6.2; beta += 0.2) {
            for (double rho = 0.1; rho < 2.8; rho += 0.1)
                test::take_worst(
                    worst, std::fabs(parts.at({beta, 5, rho}).value - other.at({beta + turn, 5, rho}).value));
        }
        MESSAGE("weights differ by ", worst, " at most");
        CHECK(worst < 0.02);  // points of outlines stand for cells that do not turn
    }
}

TEST_CASE("parts: one bears as much wherever it lies about the axis") {
    std::mt19937 random(8);
    test::Solid solid = test::cylinder({.columns = ring_columns, .rows = 8, .length = tube_length}, random);
    for (glm::vec3& p : solid.positions) p = {0.5f * p.x + 0.35f, 0.5f * p.y, p.z};
    const auto deep = [](double) { return 0.4; };
    double least = 1, most = 0;
    for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.2) {
        const test::Solid turned = turned_about_axis(solid, turn);
        fit::Parts parts(turned.geometry(), base_of_tube());
        parts.weigh(deep, deep);
        const double weight = parts.at({turn, 5, 0.85}).value;
        least = std::min(least, weight);
        most = std::max(most, weight);
    }
    MESSAGE("weights from ", least, " to ", most);
    CHECK(most < 1);
    CHECK(most < 1.005 * least);
}

TEST_CASE("parts: they bear more where the body cannot make up for their area") {
    const test::Solid solid = tube_and_rods({.radius = 0.3, .distance = 1.5, .count = 6, .apart = 1.05});
    fit::BindOptions options;
    options.amplitude = fit::Amplitude::mesh;
    const fit::Binding binding = fit::bind(solid.geometry(), base_of_tube(), options);
    const double rest = fit::surface_area(solid.positions, solid.triangles);
    std::vector<glm::vec3> bent(solid.positions.size());
    double mean = 0;
    for (int i = 0; i < 16; ++i) {
        const auto direction = static_cast<float>(2 * std::numbers::pi * i / 16);
        bend::DeformJob job{.body = &binding.body, .pose = {std::numbers::pi_v<float> / 2, direction}};
        job.positions = interleaved<3>(&bent[0].x, bent.size());
        bend::run(job);
        mean += fit::surface_area(bent, solid.triangles) / rest / 16;
    }
    MESSAGE("area ", mean);
    CHECK(std::fabs(mean - 1) < 0.005);  // 0.98 if they bore as little as elsewhere
}

TEST_CASE("parts: levels of one rig agree") {
    const test::Solid solid = tube_and_rod(0.15, 1.5);
    const fit::Binding rig = fit::bind(solid.geometry(), base_of_tube());
    test::Solid level = solid;  // every other triangle
    level.triangles.clear();
    for (std::size_t t = 0; t + 2 < solid.triangles.size(); t += 6)
        level.triangles.insert(level.triangles.end(),
                               solid.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                               solid.triangles.begin() + static_cast<std::ptrdiff_t>(t + 3));
    const fit::Binding coarse = fit::bind_level(level.geometry(), rig);
    std::vector<glm::vec3> a(solid.positions.size()), b(a.size());
    bend::DeformJob job{.body = &rig.body, .pose = {1.2f, 0.4f}};
    job.positions = interleaved<3>(&a[0].x, a.size());
    bend::run(job);
    job.body = &coarse.body;
    job.positions = interleaved<3>(&b[0].x, b.size());
    bend::run(job);
    CHECK(a == b);
}

TEST_CASE("parts: folds that were asked for are made as deep as they are, whatever the parts") {
    const test::Solid solid = tube_and_rod(0.15, 1.5);
    fit::BindOptions options;
    options.folds = 13;
    CHECK(fit::bind(solid.geometry(), base_of_tube(), options).parts == nullptr);
    options = fit::BindOptions::as_in_paper();
    CHECK(fit::bind(solid.geometry(), base_of_tube(), options).parts == nullptr);
}

}  // namespace goffer
