// SPDX-License-Identifier: MIT
#include "support/accuracy.hpp"
#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/bounds.hpp>

#include <doctest/doctest.h>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

/// The wrinkles' weight: from the whole wrinkle to the bits of the bare bend.

namespace goffer::test {
namespace {

struct Folded {
    TestMesh test_mesh;
    fit::Binding binding, bare;  // the same mesh with folds and without
};

Folded folded(Random& random) {
    TestMesh test_mesh = random_mesh(random, 12, 1);
    fit::BindOptions options;
    options.folds = 4;
    fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    options.folds = 0;
    fit::Binding bare = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    return {std::move(test_mesh), std::move(binding), std::move(bare)};
}

bool same_numbers(const Output& a, const Output& b) {
    for (std::size_t c = 0; c < 10; ++c)
        if (!std::ranges::equal(a.columns[c], b.columns[c])) return false;
    return true;
}

}  // namespace

TEST_CASE(
    "wrinkles are as deep as the factor of the direction in which a body is bent, also by a negative angle") {
    Random random(83);
    constexpr std::size_t count = 500;
    const LooseVertices loose(random, count, 0.11);
    bend::RegionInput region = loose_region(count);
    const bend::Body plain = loose.body({&region, 1});
    region.factors.max_angle = plain.max_angle();
    region.factors.rows.resize(2);
    for (auto& row : region.factors.rows) {
        for (std::size_t d = 0; d < row.size(); ++d)
            row[d] =
                static_cast<float>(1 + 0.8 * std::cos(2 * std::numbers::pi * static_cast<double>(d) / 16));
    }
    const bend::Body own = loose.body({&region, 1});
    const auto deepest = [&](const bend::Body& of, const bend::Pose& pose) {
        Output bare(of.vertex_count()), all(of.vertex_count());
        bend::DeformJob job = make_job(of, pose, Isa::automatic, bare);
        job.wrinkle_weight = 0;
        bend::run(job);
        bend::run(make_job(of, pose, Isa::automatic, all));
        double most = 0;
        for (std::size_t i = 0; i < of.vertex_count(); ++i)
            take_worst(most, glm::length(all.position(i) - bare.position(i)));
        return most;
    };
    for (const float angle : {0.9f, -0.9f}) {
        for (const float direction : {0.0f, 0.7f, 2.0f, 3.1f}) {
            CAPTURE(angle);
            CAPTURE(direction);
            const float toward = direction + (angle < 0 ? std::numbers::pi_v<float> : 0);
            const double factor{region.factors.at(std::fabs(angle), toward)};
            const bend::Pose pose{angle, direction};
            CHECK(deepest(own, pose) == doctest::Approx(factor * deepest(plain, pose)).epsilon(1e-3));
        }
    }
}

TEST_CASE("without wrinkles a body bends as one that has no folds") {
    Random random(69);
    const Folded body = folded(random);
    const std::size_t count = body.test_mesh.positions.size();
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        Output a(count), b(count);
        bend::DeformJob job = make_job(body.binding.body, {1.3f, 2.0f}, isa, a);
        job.wrinkle_weight = 0;
        bend::run(job);
        bend::run(make_job(body.bare.body, {1.3f, 2.0f}, isa, b));
        CHECK(same_numbers(a, b));
        job.wrinkle_weight = 1;
        bend::run(job);
        CHECK_FALSE(same_numbers(a, b));
    }
}

TEST_CASE("wrinkles grow in proportion to their weight") {
    // A vertex moves along a straight line as its wrinkle grows: away from the axis.
    Random random(70);
    const Folded body = folded(random);
    const std::size_t count = body.test_mesh.positions.size();
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        Output none(count), all(count), some(count);
        bend::DeformJob job = make_job(body.binding.body, {1.3f, 2.0f}, isa, none);
        job.wrinkle_weight = 0;
        bend::run(job);
        bend::run(make_job(body.binding.body, {1.3f, 2.0f}, isa, all));
        double deepest = 0;
        for (std::size_t i = 0; i < count; ++i)
            deepest = std::max(deepest, glm::length(all.position(i) - none.position(i)));
        CHECK(deepest > 0.01);
        for (const float weight : {1e-6f, 0.01f, 0.25f, 0.5f, 0.9f, 0.999f}) {
            CAPTURE(weight);
            job = make_job(body.binding.body, {1.3f, 2.0f}, isa, some);
            job.wrinkle_weight = weight;
            REQUIRE(bend::validate(job).none());
            bend::run(job);
            const auto share = static_cast<double>(weight);
            for (std::size_t i = 0; i < count; ++i) {
                const glm::dvec3 expected = (1 - share) * none.position(i) + share * all.position(i);
                REQUIRE(glm::length(some.position(i) - expected) < 5e-7);
                REQUIRE(std::fabs(glm::length(some.normal(i)) - 1) < 1e-6);
            }
        }
        // Normals fade as positions do: those of a weight near an end are near the end's.
        for (const auto& [weight, end] : {std::pair{1e-5f, &none}, std::pair{1 - 1e-5f, &all}}) {
            job.wrinkle_weight = weight;
            bend::run(job);
            for (std::size_t i = 0; i < count; ++i)
                REQUIRE(angle_between(some.normal(i), end->normal(i)) < 4e-3);
        }
    }
}

TEST_CASE("a weight that is no share is clamped, NaN to none") {
    Random random(71);
    const std::size_t counts[] = {40, 1, 60};
    const bend::Body body = loose_chain(random, counts);
    const std::vector<bend::Pose> poses{{1, 2}, {-2, 1}, {3, 0}};
    constexpr std::string_view picture = "x y z u v w a b c d p q r 123";
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Isa isa : isas_here()) {
        const auto run_to = [&](OutputBuffer& out, float weight) {
            bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = weight, .isa = isa};
            job.previous_poses = std::span(poses);
            out.attach(job);
            bend::run(job);
        };
        OutputBuffer none(picture, 101), all(picture, 101);
        run_to(none, 0);
        run_to(all, 1);
        CHECK(all.fault(none) != "");
        for (const float weight : {nan, -nan, -0.0f, -1e-45f, -1.0f, -infinity}) {
            OutputBuffer out(picture, 101);
            run_to(out, weight);
            CHECK(out.fault(none) == "");
        }
        for (const float weight : {1.0f, 1.0001f, 3e38f, infinity}) {
            OutputBuffer out(picture, 101);
            run_to(out, weight);
            CHECK(out.fault(all) == "");
        }
    }
}

TEST_CASE("P10: bounds hold the vertices whatever the weight, and shrink with it") {
    Random random(72);
    const Folded body = folded(random);
    const std::size_t count = body.test_mesh.positions.size();
    Output out(count);
    double volume = 0;
    for (const float weight : {0.0f, 0.2f, 0.7f, 1.0f}) {
        bend::DeformJob job = make_job(body.binding.body, {1.9f, -0.4f}, Isa::automatic, out);
        job.wrinkle_weight = weight;
        bend::run(job);
        const bend::Bounds box = bend::bounds(job);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p(out.position(i));
            REQUIRE(glm::all(glm::lessThanEqual(box.low, p)));
            REQUIRE(glm::all(glm::lessThanEqual(p, box.high)));
        }
        const glm::dvec3 size(box.high - box.low);
        CHECK(size.x * size.y * size.z >= volume);
        volume = size.x * size.y * size.z;
    }
}

}  // namespace goffer::test
