// SPDX-License-Identifier: MIT
#include "support/accuracy.hpp"

#include "support/bodies.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Properties P1, P2, P4 and P8: the float kernels of every instruction set against the double closed form.

namespace goffer::test {
namespace {

/// `area` only with folds of at most two radii: the area of folds that reach past the axis means nothing. And
/// not with even folds or fewer than three of the smooth profile, whose factor has a corner near rest that
/// the table rounds off.
fit::BindOptions random_accurate_options(Random& random, const fit::Cylinder& cylinder) {
    fit::BindOptions options;
    options.folds = static_cast<int>(random() % 13);
    options.profile = random_profile(random);
    if (options.profile.kind == paper::Profile::Kind::even) *options.folds *= 2;
    const int oscillations = options.profile.folds_of_length(*options.folds);
    const bool shallow = oscillations * 2 * cylinder.radius >= cylinder.length && cylinder.radii.empty();
    const bool corner = options.profile.kind == paper::Profile::Kind::even ||
                        (options.profile == paper::Profile::smooth && *options.folds < 3);
    options.amplitude =
        shallow && !corner && random() % 2 == 0 ? paper::Amplitude::area : paper::Amplitude::paper;
    return options;
}

bend::Pose random_pose_within(Random& random, double max_angle) {
    const double kind = uniform(random, 0, 1);
    const double angle = kind < 0.2   ? std::pow(10, uniform(random, -7, 0)) * std::min(max_angle, 1.0)
                         : kind < 0.3 ? max_angle * (1 - 1e-6)
                                      : uniform(random, 0, max_angle) * (1 - 1e-6);
    const double direction = random() % 5 == 0 ? 0 : uniform(random, -20, 20);
    return {static_cast<float>(random() % 4 == 0 ? -angle : angle), static_cast<float>(direction)};
}

}  // namespace

TEST_CASE("P2, P4: every instruction set agrees with the double closed form") {
    Random random(1);
    std::vector<Worst> worst(built_isas().size());
    for (int trial = 0; trial < rounds(40, 10); ++trial) {
        const double scale = std::pow(10, uniform(random, -4, 4));
        const bool slender = trial % 8 == 7;
        TestMesh test_mesh =
            random_mesh(random, slender ? uniform(random, 100, 500) : uniform(random, 3, 40), scale);
        if (trial % 3 == 0) add_radii(test_mesh, random);
        fit::BindOptions options = random_accurate_options(random, test_mesh.cylinder);
        if (slender) {  // other profiles take the reference seconds
            options.profile = paper::Profile::even;
            options.folds = 2 * fit::BindOptions::max_folds - static_cast<int>(random() % 100);
            options.amplitude = paper::Amplitude::paper;
        }
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        Output out(test_mesh.positions.size());
        for (int k = 0; k < 5; ++k) {
            const bend::Pose pose = random_pose_within(random, static_cast<double>(binding.body.max_angle()));
            INFO("trial ", trial, " angle ", pose.angle, " of ", binding.body.max_angle(), " direction ",
                 pose.direction, " folds ", binding.folds(), " L/r ",
                 test_mesh.cylinder.length / test_mesh.cylinder.radius);
            const double half_turns = std::fabs(static_cast<double>(pose.angle)) / std::numbers::pi;
            const Expected expected(Reference(test_mesh, options, binding, pose), test_mesh.positions.size());
            for (std::size_t i = 0; i < worst.size(); ++i) {
                const Isa isa = built_isas()[i];
                if (!runs_here(isa)) continue;
                CAPTURE(name(isa));
                const bend::DeformJob job = make_job(binding.body, pose, isa, out);
                REQUIRE(bend::validate(job).none());
                bend::run(job);
                const Worst one(expected, out, test_mesh.cylinder.length);
                CHECK(one.position <= 5e-6);
                CHECK(one.normal <= 0.01);
                CHECK(one.tangent <= 0.01);
                CHECK(one.unit <= 1e-6);
                // A few of float's steps, doubled with the arc beyond a half turn; of the many turns of a
                // slender body, as many for each half turn.
                CHECK(one.skew <= 1e-5 * (slender ? std::max(1.0, half_turns) : 1.0));
                worst[i].add(one);
            }
        }
    }
    for (std::size_t i = 0; i < worst.size(); ++i) {
        const Worst& w = worst[i];
        MESSAGE(name(built_isas()[i]), ": position ", w.position, " L, normal ", w.normal, " deg, tangent ",
                w.tangent, " deg, unit ", w.unit, ", normal . tangent ", w.skew);
    }
}

TEST_CASE("P1: the straight pose returns the rest mesh") {
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        Random random(2);
        for (int trial = 0; trial < 20; ++trial) {
            TestMesh test_mesh =
                random_mesh(random, uniform(random, 3, 40), std::pow(10, uniform(random, -4, 4)));
            if (trial % 3 == 0) add_radii(test_mesh, random);
            const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder,
                                                   random_accurate_options(random, test_mesh.cylinder));
            Output out(test_mesh.positions.size());
            bend::run(make_job(binding.body, {0, static_cast<float>(uniform(random, -9, 9))}, isa, out));
            for (std::size_t i = 0; i < test_mesh.positions.size(); ++i) {
                const double error = glm::length(out.position(i) - glm::dvec3(test_mesh.positions[i]));
                REQUIRE(error <= 1e-6 * test_mesh.cylinder.length);
                REQUIRE(angle_between(out.normal(i), glm::dvec3(test_mesh.normals[i])) < 1e-4);
                REQUIRE(angle_between(out.tangent(i), glm::dvec3(test_mesh.tangents[i])) < 1e-4);
                REQUIRE(out.columns[9][i] == test_mesh.tangents[i].w);
            }
        }
    }
}

TEST_CASE("P8: bending a body of revolution another way is turning the result") {
    Random random(3);
    constexpr int columns = 36;
    TestMesh test_mesh;
    test_mesh.cylinder.length = 10;
    test_mesh.cylinder.radius = 1;
    for (int row = 0; row <= 80; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * column / columns, z = row / 8.0;
            const double rho = 1 + 0.1 * std::sin(z);
            test_mesh.positions.emplace_back(rho * std::cos(beta), rho * std::sin(beta), z);
            if (row == 80) continue;
            const auto index = [&](int r, int k) {
                return static_cast<std::uint32_t>(r * columns + k % columns);
            };
            test_mesh.triangles.insert(test_mesh.triangles.end(),
                                       {index(row, column), index(row, column + 1), index(row + 1, column)});
        }
    }
    fit::BindOptions options;
    options.folds = 5;
    const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    const std::size_t count = test_mesh.positions.size();
    Output straight(count), turned(count);
    bend::run(make_job(binding.body, {1.4f, 0}, Isa::automatic, straight));
    for (const int step : {1, 7, 18, 35}) {
        const double theta = 2 * std::numbers::pi * step / columns;
        bend::run(make_job(binding.body, {1.4f, static_cast<float>(theta)}, Isa::automatic, turned));
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t row = i / columns, column = i % columns;
            const glm::dvec3 p = straight.position(
                row * columns + (column + columns - static_cast<std::size_t>(step)) % columns);
            const glm::dvec3 expected(p.x * std::cos(theta) - p.y * std::sin(theta),
                                      p.x * std::sin(theta) + p.y * std::cos(theta), p.z);
            REQUIRE(glm::length(turned.position(i) - expected) < 5e-6);
        }
    }
}

TEST_CASE("a negative angle is the same bend the other way") {
    Random random(4);
    const TestMesh test_mesh = random_mesh(random, 10, 1);
    const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder);
    Output there(test_mesh.positions.size()), back(test_mesh.positions.size());
    bend::run(make_job(binding.body, {-0.8f, 0.5f}, Isa::automatic, there));
    bend::run(make_job(binding.body, {0.8f, 0.5f + std::numbers::pi_v<float>}, Isa::automatic, back));
    for (std::size_t i = 0; i < test_mesh.positions.size(); ++i) {
        REQUIRE(glm::length(there.position(i) - back.position(i)) < 2e-6);
    }
}

TEST_CASE("beyond the largest angle the pose is clamped, flagged and finite") {
    Random random(5);
    const TestMesh test_mesh = random_mesh(random, 8, 1);
    const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder);
    Output limit(test_mesh.positions.size()), beyond(test_mesh.positions.size());
    CHECK_FALSE(
        bend::run(make_job(binding.body, {binding.body.max_angle(), 1}, Isa::automatic, limit)).clamped);
    for (const float angle : {binding.body.max_angle() * 1.01f, 100.0f, 1e30f}) {
        CHECK(bend::run(make_job(binding.body, {angle, 1}, Isa::automatic, beyond)).clamped);
        for (std::size_t i = 0; i < test_mesh.positions.size(); ++i)
            REQUIRE(limit.position(i) == beyond.position(i));
    }
}

}  // namespace goffer::test
