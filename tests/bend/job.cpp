// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/bend/rest_vertex.hpp>
#include <goffer/engine/parallel.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <thread>

/// The job's contract: any count and stride, nothing written out of bounds, bits that depend on
/// nothing but the instruction set.

namespace goffer::test {
namespace {

fit::Binding bound_body(Random& random, int extra = 100) {
    const TestMesh test_mesh = random_mesh(random, 10, 1, 8, 9, extra);
    fit::BindOptions options;
    options.folds = 3;
    return fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
}

bool same_output_bits(const Output& a, const Output& b) {
    for (std::size_t c = 0; c < 10; ++c) {
        if (std::memcmp(a.columns[c].data(), b.columns[c].data(), a.columns[c].size_bytes()) != 0)
            return false;
    }
    return true;
}

constexpr bend::Pose pose{1.1f, 0.7f};

}  // namespace

TEST_CASE("P5: any split, any thread count, the same bits") {
    Random random(6);
    const fit::Binding binding = bound_body(random, 1000);
    const std::size_t count = binding.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        CAPTURE(name(isa));
        Output whole(count);
        bend::run(make_job(binding.body, pose, isa, whole));
        for (const std::size_t step : {1u, 3u, 16u, 100u, 777u}) {
            Output parts(count);
            const bend::DeformJob job = make_job(binding.body, pose, isa, parts);
            for (std::size_t first = 0; first < count; first += step) {
                bend::run_range(job, first, std::min(first + step, count));
            }
            CHECK(same_output_bits(whole, parts));
        }
        for (const std::size_t grain : {0u, 1u, 50u, 100000u}) {
            Output parallel(count);
            bend::run_parallel(make_job(binding.body, pose, isa, parallel), grain);
            CHECK(same_output_bits(whole, parallel));
        }
    }
}

TEST_CASE("P5: threads of the caller share a body and a job, the same bits") {
    Random random(6);
    const fit::Binding binding = bound_body(random, 1000);
    const std::size_t count = binding.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        CAPTURE(name(isa));
        Output whole(count);
        bend::run(make_job(binding.body, pose, isa, whole));
        Output threads(count);
        const bend::DeformJob job = make_job(binding.body, pose, isa, threads);
        std::thread first([&] { bend::run_range(job, 0, count / 3); });
        std::thread second([&] { bend::run_range(job, count / 3, count); });
        first.join();
        second.join();
        CHECK(same_output_bits(whole, threads));
    }
}

TEST_CASE("streams wanted alone give the bits that they give together") {
    Random random(7);
    const fit::Binding binding = bound_body(random);
    const std::size_t count = binding.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        Output all(count);
        bend::run(make_job(binding.body, pose, isa, all));
        for (unsigned mask = 1; mask < 8; ++mask) {
            Output some(count);
            bend::DeformJob job = make_job(binding.body, pose, isa, some);
            if ((mask & 1) == 0) job.positions = {};
            if ((mask & 2) == 0) job.normals = {};
            if ((mask & 4) == 0) job.tangents = {};
            bend::run(job);
            for (std::size_t c = 0; c < 10; ++c) {
                const bool wanted = ((c < 3 ? 1u : c < 6 ? 2u : 4u) & mask) != 0;
                for (std::size_t i = 0; i < count; ++i)
                    REQUIRE(some.columns[c][i] == (wanted ? all.columns[c][i] : 0.0f));
            }
        }
    }
}

TEST_CASE("exact edges: every vertex count, misaligned outputs of exactly that length") {
    Random random(9);
    for (std::size_t count = 1; count <= 40; ++count) {
        std::vector<bend::RestVertex> vertices(count);
        std::vector<bend::RestVector> normals(count, {1, 0, 0});
        for (bend::RestVertex& v : vertices) v = {uniform(random, -3, 3), uniform(random, 0, 1), 0.1, 0, 0};
        const bend::Body body = bare_body(vertices, normals);
        for (const Isa isa : built_isas()) {
            if (!runs_here(isa)) continue;
            // Under a sanitizer one float too many is seen.
            std::vector<float> buffer(3 * count, std::numeric_limits<float>::quiet_NaN());
            bend::DeformJob job;
            job.body = &body;
            job.pose = {3.9f, 0};  // doubled arc
            job.isa = isa;
            job.positions =
                planar(std::span(buffer).subspan(0, count), std::span(buffer).subspan(count, count),
                       std::span(buffer).subspan(2 * count, count));
            REQUIRE(bend::validate(job).none());
            bend::run(job);
            for (const float value : buffer) REQUIRE(std::isfinite(value));
            bend::run_range(job, count, count);  // an empty range is fine
        }
    }
}

TEST_CASE("angles and directions of any finite size give finite results") {
    Random random(11);
    const fit::Binding binding = bound_body(random);
    Output out(binding.body.vertex_count());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float angle : {1.0f, 1e-38f, -1e-38f, 1e-45f, 1e38f, -1e38f}) {
        for (const float direction : {0.0f, 1e10f, 1e30f, -1e38f, -1e-30f}) {
            for (const Isa isa : built_isas()) {
                if (!runs_here(isa)) continue;
                for (std::size_t c = 0; c < 9; ++c) std::ranges::fill(out.columns[c], nan);
                const bend::DeformResult result =
                    bend::run(make_job(binding.body, {angle, direction}, isa, out));
                CHECK_FALSE(result.at_rest);
                CHECK(result.clamped == (std::fabs(angle) > 10));
                for (std::size_t c = 0; c < 9; ++c) {
                    for (const float value : out.columns[c]) REQUIRE(std::isfinite(value));
                }
            }
        }
    }
}

/// The direction of a pose in that direction, as kernels see it.
double direction_of(const bend::Body& body, float direction, Isa isa) {
    bend::Pose toward{1, direction};
    bend::Batch batch;
    batch.body = &body;
    batch.count = 1;
    batch.poses = {.data = &toward, .count = 1};
    bend::Coefficients k;
    bend::set_up(batch, {&k, 1}, isa);
    return 2 *
           std::atan2(static_cast<double>(k.sin_half_direction), static_cast<double>(k.cos_half_direction));
}

TEST_CASE("directions of any size are taken to a half turn either way") {
    const double turn = 2 * std::numbers::pi;
    const float half_turn = std::numbers::pi_v<float>;
    Random random(13);
    const bend::Body body = loose_body(random, 1);
    for (const Isa isa : isas_here()) {
        for (const float size : {3.0f, 7.0f, 100.0f, 1e5f, 4e5f, 5e5f, 1e20f, 3e38f}) {
            for (int i = 0; i < 2000; ++i) {
                const auto direction = static_cast<float>(uniform(random, -1, 1)) * size;
                const double off =
                    std::remainder(static_cast<double>(direction), turn) - direction_of(body, direction, isa);
                CAPTURE(direction);
                REQUIRE(std::fabs(std::remainder(off, turn)) < 1e-6);
            }
        }
        CHECK(direction_of(body, half_turn, isa) > 3);
        CHECK(direction_of(body, -half_turn, isa) < -3);
        CHECK(direction_of(body, -1e-7f, isa) < 0);
    }
}

TEST_CASE("a body that is bent at rest has no wrinkles there, whatever its direction") {
    Random random(14);
    for (const float direction : {3.0f, -4.0f, 100.0f, -999.0f}) {
        bend::RegionInput region = loose_region(100);
        region.rest_angle = 1.2;
        region.rest_direction = static_cast<double>(direction);
        const bend::Body body = LooseVertices(random, 100, 0.11).body({&region, 1});
        Output out(100), half(100);
        for (const Isa isa : isas_here()) {
            bend::DeformJob job = make_job(body, {1.2f, direction}, isa, out);
            bend::run(job);
            job = make_job(body, {1.2f, direction}, isa, half);
            job.wrinkle_weight = 0.5f;
            bend::run(job);
            CAPTURE(direction);
            CHECK(same_output_bits(out, half));
        }
    }
}

TEST_CASE("whole turns of a direction change nothing but roundings, at half turns too") {
    Random random(12);
    bend::RegionInput region = loose_region(200);
    region.factors.max_angle = 4.9f;
    region.factors.rows.resize(3);
    for (auto& row : region.factors.rows)
        for (float& square : row) square = static_cast<float>(uniform(random, 0.2, 2));
    const bend::Body bodies[] = {bound_body(random).body,
                                 LooseVertices(random, 200, 0.11).body({&region, 1})};
    const float half_turn = std::numbers::pi_v<float>;
    for (const bend::Body& body : bodies) {
        Output out(body.vertex_count()), wrapped(body.vertex_count());
        for (const float near : {0.0f, 0.3f, half_turn, -half_turn, 2.0f}) {
            for (const float turns : {0.0f, 1.0f, -1.0f, 3.0f, -100.0f, 6e4f, 1e5f, 1e8f}) {
                const float direction = near + turns * 2 * half_turn;
                const auto same =
                    static_cast<float>(std::remainder(static_cast<double>(direction), 2 * std::numbers::pi));
                CAPTURE(direction);
                bend::run(make_job(body, {0.9f, direction}, Isa::automatic, out));
                bend::run(make_job(body, {0.9f, same}, Isa::automatic, wrapped));
                for (std::size_t i = 0; i < body.vertex_count(); ++i)
                    REQUIRE(glm::length(out.position(i) - wrapped.position(i)) < 2e-6 * body.length());
            }
        }
    }
}

TEST_CASE("ranges cover all once, in any grain") {
    for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
        for (const std::size_t grain : {0u, 1u, 3u, 5000u}) {
            std::vector<int> seen(count, 0);
            parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) ++seen[i];
            });
            for (const int times : seen) REQUIRE(times == 1);
        }
    }
}

}  // namespace goffer::test
