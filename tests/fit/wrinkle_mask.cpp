// SPDX-License-Identifier: MIT
#include "mask.hpp"
#include "support/angles.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/normals.hpp>
#include <goffer/fit/sockets.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

/// Geometry::wrinkle_mask: how much of its wrinkle each vertex follows.

using namespace goffer;
using namespace goffer::test;

namespace {

struct Bent {
    std::vector<glm::vec3> positions, normals;
};

/// In the geometry's order.
Bent bent_with_normals(const fit::Binding& binding, float wrinkle_weight, double angle = right_angle) {
    const bend::Body& body = binding.body;
    std::vector<bend::Pose> poses;
    for (std::size_t i = 0; i < body.region_count(); ++i)
        poses.push_back({static_cast<float>(angle / static_cast<double>(body.region_count())), 0.4f});
    Bent made{std::vector<glm::vec3>(body.vertex_count()), std::vector<glm::vec3>(body.vertex_count())};
    bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = wrinkle_weight};
    job.positions = interleaved<3>(&made.positions[0].x, made.positions.size());
    job.normals = interleaved<3>(&made.normals[0].x, made.normals.size());
    bend::run(job);
    if (binding.order.empty()) return made;
    Bent sorted = made;
    for (std::size_t i = 0; i < binding.order.size(); ++i) {
        sorted.positions[binding.order[i]] = made.positions[i];
        sorted.normals[binding.order[i]] = made.normals[i];
    }
    return sorted;
}

Solid tube_of(int columns, int rows) {
    std::mt19937 random(1);
    return cylinder({.columns = columns, .rows = rows, .closed = false}, random);
}

Solid very_fine_tube() {
    return tube_of(64, 481);
}

fit::Geometry masked(const Solid& solid, const std::vector<float>& mask) {
    fit::Geometry geometry = solid.geometry();
    geometry.wrinkle_mask = mask;
    return geometry;
}

/// A mask of the height as a share of the length, and of the direction about the axis.
template <class Value>
std::vector<float> mask_of(const Solid& solid, const Value& value) {
    std::vector<float> mask;
    for (const glm::vec3& p : solid.positions)
        mask.push_back(static_cast<float>(value(p.z / 10.0, std::atan2(p.y, p.x))));
    return mask;
}

double smooth(double x) {
    return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(x, 0.0, 1.0));
}

/// The largest angle, degrees, of the kernels' normals with those of the bent triangles, away from the ends.
double worst_normal(const Solid& solid, const Bent& result) {
    const std::vector<glm::vec3> truth = fit::make_normals(result.positions, solid.triangles);
    float least = 1;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (solid.positions[i].z > 0.1f && solid.positions[i].z < 9.9f)
            test::take_least(least, glm::dot(glm::normalize(truth[i]), glm::normalize(result.normals[i])));
    }
    return glm::degrees(std::acos(static_cast<double>(least)));
}

std::string mask_error(const std::vector<float>& mask) {
    const Solid solid = tube();
    try {
        (void)fit::bind(masked(solid, mask), upright());
    } catch (const fit::Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("wrinkle mask: a vertex follows so much of its wrinkle, with any profile, amplitude and regions") {
    const Solid solid = tube_of(32, 121);
    const std::vector<float> mask =
        mask_of(solid, [](double z, double beta) { return 0.5 + 0.5 * std::sin(7 * z + 2 * beta); });
    for (const fit::Profile profile : {fit::Profile::even, fit::Profile::damped, fit::Profile::smooth}) {
        for (const fit::Amplitude amplitude : {fit::Amplitude::paper, fit::Amplitude::mesh}) {
            for (const std::size_t regions : {1u, 3u}) {
                fit::BindOptions options;
                options.profile = profile;
                options.amplitude = amplitude;
                options.regions.assign(regions, {1.0 / static_cast<double>(regions), std::nullopt});
                const fit::Binding plain = fit::bind(solid.geometry(), upright(), options);
                const Bent bare = bent_with_normals(plain, 0), full = bent_with_normals(plain, 1),
                           part = bent_with_normals(fit::bind(masked(solid, mask), upright(), options), 1);
                double worst = 0, deepest = 0;
                for (std::size_t i = 0; i < mask.size(); ++i) {
                    const glm::vec3 expected = glm::mix(bare.positions[i], full.positions[i], mask[i]);
                    test::take_worst(worst, double{glm::distance(part.positions[i], expected)});
                    deepest = std::max(deepest, double{glm::distance(bare.positions[i], full.positions[i])});
                }
                CHECK(worst < 5e-6);
                CHECK(deepest > 0.08);
            }
        }
    }
}

TEST_CASE("wrinkle mask: normals follow a mask that changes along the body") {
    const Solid solid = very_fine_tube();
    const auto along = [](double z, double) { return smooth((z - 0.4) / 0.1); };
    const double whole = worst_normal(solid, bent_with_normals(fit::bind(solid.geometry(), upright()), 1));
    const double half =
        worst_normal(solid, bent_with_normals(fit::bind(masked(solid, mask_of(solid, along)), upright()), 1));
    MESSAGE("degrees: " << whole << " without a mask, " << half << " with one");
    CHECK(half < 1.2 * whole + 0.1);
}

TEST_CASE("wrinkle mask: around the body, normals lag by depth over width") {
    const Solid solid = very_fine_tube();
    constexpr double from = 0.4, width = 1.2;  // radians, and radii
    const auto around = [](double, double beta) {
        return smooth((std::fabs(std::remainder(beta - 0.4, 2 * std::numbers::pi)) - from) / width);
    };
    const fit::Binding binding = fit::bind(masked(solid, mask_of(solid, around)), upright());
    const Bent bare = bent_with_normals(fit::bind(solid.geometry(), upright()), 0),
               full = bent_with_normals(fit::bind(solid.geometry(), upright()), 1);
    double depth = 0;
    for (std::size_t i = 0; i < bare.positions.size(); ++i)
        depth = std::max(depth, double{glm::distance(bare.positions[i], full.positions[i])});
    const double steepest = std::numbers::pi / 2 * depth / width;  // of a cosine's half wave
    const double lag = worst_normal(solid, bent_with_normals(binding, 1));
    MESSAGE("degrees: " << lag << " seen, " << glm::degrees(std::atan(steepest)) << " promised");
    CHECK(lag > 1);
    CHECK(lag < glm::degrees(std::atan(steepest)));
}

TEST_CASE("wrinkle mask: its slope is that along the body, however it changes about it") {
    std::mt19937 random(3);
    Solid solid = cylinder({.columns = 48, .rows = 40, .closed = false, .jitter = 0.4}, random);
    // Neighbors in memory have nothing to do with each other.
    for (std::size_t t = solid.triangles.size() / 3; t-- > 1;) {
        const auto own = solid.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t);
        std::swap_ranges(own, own + 3,
                         solid.triangles.begin() + static_cast<std::ptrdiff_t>(3 * (random() % t)));
    }
    const auto from_ridge = [](double beta) {
        return std::remainder(beta - 0.5 * std::numbers::pi, 2 * std::numbers::pi);
    };
    const std::vector<float> values = mask_of(
        solid, [&](double z, double beta) { return 0.2 + 0.3 * z + 0.15 * std::fabs(from_ridge(beta)); });
    const fit::Geometry geometry = masked(solid, values);
    const fit::Mask mask(geometry, upright());
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < solid.positions.size(); ++i) {
        const double beta = std::atan2(solid.positions[i].y, solid.positions[i].x);
        if (std::fabs(std::cos(from_ridge(beta))) > 0.9) continue;  // the ridge and the valley
        REQUIRE(mask.at(i).slope == doctest::Approx(0.03).epsilon(1e-3));
        ++looked_at;
    }
    CHECK(looked_at > 1000);
}

TEST_CASE("wrinkle mask: vertices at one place that a seam has split have one normal") {
    const Solid solid = very_fine_tube();
    const std::size_t count = solid.positions.size();
    std::vector<glm::vec3> positions = solid.positions,
                           normals = fit::make_normals(solid.positions, solid.triangles);
    std::vector<std::uint32_t> triangles = solid.triangles;
    positions.insert(positions.end(), solid.positions.begin(), solid.positions.end());
    normals.resize(2 * count);
    std::copy_n(normals.begin(), count, normals.begin() + static_cast<std::ptrdiff_t>(count));
    // A seam around the body, in the middle of the mask's edge.
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        float low = 10;
        for (std::size_t i = t; i < t + 3; ++i) low = std::min(low, positions[triangles[i]].z);
        for (std::size_t i = t; i < t + 3; ++i)
            triangles[i] += low > 4.49f ? static_cast<std::uint32_t>(count) : 0;
    }
    std::vector<float> mask;
    for (const glm::vec3& p : positions) mask.push_back(p.z > 4.49f ? 1.0f : 0.0f);
    const fit::Geometry geometry{positions, triangles, normals, {}, mask};
    const Bent result = bent_with_normals(fit::bind(geometry, upright()), 1);
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i)
        test::take_worst(worst, double{glm::distance(result.normals[i], result.normals[count + i])});
    CHECK(worst < 1e-6);
}

TEST_CASE("wrinkle mask: a socket goes where its place on the mesh goes") {
    const Solid solid = very_fine_tube();
    const std::vector<float> mask = mask_of(solid, [](double z, double) { return smooth((z - 0.3) / 0.4); });
    const fit::Geometry geometry = masked(solid, mask);
    const fit::Binding binding = fit::bind(geometry, upright());
    const Bent result = bent_with_normals(binding, 1);
    const std::vector<bend::Pose> poses{{static_cast<float>(right_angle), 0.4f}};
    bend::DeformJob job{.body = &binding.body, .poses = poses};
    double worst = 0, unmasked = 0;
    for (std::size_t i = 100; i < solid.positions.size(); i += 997) {
        std::vector<bend::Socket> sockets{
            fit::socket_near(binding, geometry, glm::dvec3(solid.positions[i])),
            fit::socket_near(binding, solid.geometry(), glm::dvec3(solid.positions[i]))};
        bend::SocketFrame frames[2];
        bend::Sockets::make(binding.body, sockets).value().frames(job, frames);
        test::take_worst(worst, double{glm::distance(frames[0][3], result.positions[i])});
        unmasked = std::max(unmasked, double{glm::distance(frames[1][3], result.positions[i])});
    }
    CHECK(worst < 2e-5);
    CHECK(unmasked > 0.05);
}

TEST_CASE("wrinkle mask: one everywhere is none, and nothing anywhere is the bare bend") {
    const Solid solid = very_fine_tube();
    const std::vector<float> ones(solid.positions.size(), 1.0f), zeros(solid.positions.size());
    for (const fit::Amplitude amplitude : {fit::Amplitude::paper, fit::Amplitude::mesh}) {
        fit::BindOptions options;
        options.amplitude = amplitude;
        const fit::Binding plain = fit::bind(solid.geometry(), upright(), options);
        CHECK((bent_with_normals(fit::bind(masked(solid, ones), upright(), options), 1).positions ==
               bent_with_normals(plain, 1).positions));
        const Bent nothing = bent_with_normals(fit::bind(masked(solid, zeros), upright(), options), 1);
        const Bent bare = bent_with_normals(plain, 0);
        double worst = 0;
        for (std::size_t i = 0; i < bare.positions.size(); ++i)
            test::take_worst(worst, double{glm::distance(nothing.positions[i], bare.positions[i])});
        CHECK(worst < 5e-6);
    }
}

TEST_CASE("wrinkle mask: a vertex of no triangle is no reason to fail") {
    Solid solid = very_fine_tube();
    solid.positions.emplace_back(0.0f, 0.9f, 5.0f);
    const std::vector<float> halves(solid.positions.size(), 0.5f);
    const Bent bent = bent_with_normals(fit::bind(masked(solid, halves), upright()), 1);
    CHECK(std::isfinite(bent.positions.back().x));
}

TEST_CASE("wrinkle mask: a level of detail has its own") {
    const Solid fine = very_fine_tube(), level = tube();
    const fit::Binding rig = fit::bind(fine.geometry(), upright());
    const std::vector<float> zeros(level.positions.size());
    const Bent smooth = bent_with_normals(fit::bind_level(masked(level, zeros), rig), 1),
               bare = bent_with_normals(fit::bind_level(level.geometry(), rig), 0);
    double worst = 0;
    for (std::size_t i = 0; i < bare.positions.size(); ++i)
        test::take_worst(worst, double{glm::distance(smooth.positions[i], bare.positions[i])});
    CHECK(worst < 5e-6);
}

TEST_CASE("wrinkle mask: what is no mask is refused, and the vertex named") {
    const std::size_t count = tube().positions.size();
    CHECK(mask_error(std::vector<float>(count - 1, 1.0f)).find("give one per vertex or none") !=
          std::string::npos);
    for (const float bad :
         {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::vector<float> mask(count, 0.5f);
        mask[7] = bad;
        CHECK(mask_error(mask).find("wrinkle mask of vertex 7 is outside 0..1") == 0);
    }
}
