// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/engine/parallel.hpp>

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <string_view>
#include <thread>

/// The job's contract: faults named, any count and stride, nothing written out of bounds, bits that depend on
/// nothing but the instruction set.

namespace goffer::test {
namespace {

fit::Bound bound_body(Random& random, int extra = 100) {
    const Subject subject = random_subject(random, 10, 1, 8, 9, extra);
    fit::BindOptions options;
    options.folds = 3;
    return fit::bind(subject.geometry(), subject.cylinder, options);
}

bool same_bits(const Output& a, const Output& b) {
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
    const fit::Bound bound = bound_body(random, 1000);
    const std::size_t count = bound.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        CAPTURE(name(isa));
        Output whole(count);
        bend::run(make_job(bound.body, pose, isa, whole));
        for (const std::size_t step : {1u, 3u, 16u, 100u, 777u}) {
            Output parts(count);
            const bend::DeformJob job = make_job(bound.body, pose, isa, parts);
            for (std::size_t first = 0; first < count; first += step) {
                bend::run_range(job, first, std::min(first + step, count));
            }
            CHECK(same_bits(whole, parts));
        }
        for (const std::size_t grain : {0u, 1u, 50u, 100000u}) {
            Output parallel(count);
            bend::run_parallel(make_job(bound.body, pose, isa, parallel), grain);
            CHECK(same_bits(whole, parallel));
        }
    }
}

TEST_CASE("P5: threads of the caller share a body and a job, the same bits") {
    Random random(6);
    const fit::Bound bound = bound_body(random, 1000);
    const std::size_t count = bound.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        CAPTURE(name(isa));
        Output whole(count);
        bend::run(make_job(bound.body, pose, isa, whole));
        Output threads(count);
        const bend::DeformJob job = make_job(bound.body, pose, isa, threads);
        std::thread first([&] { bend::run_range(job, 0, count / 3); });
        std::thread second([&] { bend::run_range(job, count / 3, count); });
        first.join();
        second.join();
        CHECK(same_bits(whole, threads));
    }
}

TEST_CASE("streams wanted alone give the bits that they give together") {
    Random random(7);
    const fit::Bound bound = bound_body(random);
    const std::size_t count = bound.body.vertex_count();
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        Output all(count);
        bend::run(make_job(bound.body, pose, isa, all));
        for (unsigned mask = 1; mask < 8; ++mask) {
            Output some(count);
            bend::DeformJob job = make_job(bound.body, pose, isa, some);
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
            std::vector<float> buffer(3 * count);  // under a sanitizer one float too many is seen
            bend::DeformJob job;
            job.body = &body;
            job.pose = {3.9f, 0};  // doubled arc
            job.isa = isa;
            job.positions =
                planar(std::span(buffer).subspan(0, count), std::span(buffer).subspan(count, count),
                       std::span(buffer).subspan(2 * count, count));
            REQUIRE(bend::validate(job) == bend::JobFault::none);
            bend::run(job);
            for (const float value : buffer) REQUIRE(std::isfinite(value));
            bend::run_range(job, count, count);  // an empty range is fine
        }
    }
}

TEST_CASE("P7: validate names the field at fault") {
    Random random(10);
    const fit::Bound bound = bound_body(random);
    const std::size_t count = bound.body.vertex_count();
    Output out(count);
    const bend::DeformJob good = make_job(bound.body, pose, Isa::automatic, out);
    CHECK(bend::validate(good) == bend::JobFault::none);
    const auto fault = [&](auto change) {
        bend::DeformJob job = good;
        change(job);
        return bend::validate(job);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    using bend::DeformJob;
    using bend::JobFault;
    CHECK(fault([](DeformJob& j) { j.body = nullptr; }) == JobFault::body);
    CHECK(fault([&](DeformJob& j) { j.pose.angle = nan; }) == JobFault::pose_angle);
    CHECK(fault([&](DeformJob& j) { j.pose.angle = -infinity; }) == JobFault::pose_angle);
    CHECK(fault([&](DeformJob& j) { j.pose.direction = nan; }) == JobFault::pose_direction);
    CHECK(fault([](DeformJob& j) { j.positions = {}, j.normals = {}, j.tangents = {}; }) ==
          JobFault::no_streams);
    CHECK(fault([](DeformJob& j) { --j.positions.count; }) == JobFault::positions_count);
    CHECK(fault([](DeformJob& j) { j.normals.count = 0; }) == JobFault::normals_count);
    CHECK(fault([](DeformJob& j) { --j.tangents.count; }) == JobFault::tangents_count);
    CHECK(fault([](DeformJob& j) { j.positions.stride = 0; }) == JobFault::positions_stride);
    CHECK(fault([](DeformJob& j) { j.normals.stride = 6; }) == JobFault::normals_stride);
    CHECK(fault([](DeformJob& j) { j.tangents.stride = 3; }) == JobFault::tangents_stride);
    CHECK(fault([](DeformJob& j) { j.positions.component[2] = nullptr; }) == JobFault::positions_component);
    CHECK(fault([](DeformJob& j) { j.normals.component[1] = nullptr; }) == JobFault::normals_component);
    CHECK(fault([](DeformJob& j) { j.tangents.component[3] = nullptr; }) == JobFault::tangents_component);
    CHECK(fault([&](DeformJob& j) { j.positions = interleaved<3>(out.columns[0].data(), count, 8); }) ==
          JobFault::positions_stride);
    CHECK(fault([](DeformJob& j) { j.isa = static_cast<Isa>(99); }) == JobFault::isa);
    for (int c = 0; c < 4; ++c) {
        for (int row = 0; row < 3; ++row) {
            CHECK(fault([&](DeformJob& j) { j.transform[c][row] = nan; }) == JobFault::transform);
            CHECK(fault([&](DeformJob& j) { j.transform[c][row] = -infinity; }) == JobFault::transform);
            CHECK(fault([&](DeformJob& j) { j.transform[c][row] = -2e18f; }) == JobFault::transform);
            CHECK(fault([&](DeformJob& j) { j.transform[c][row] = 1e18f; }) == JobFault::none);
        }
    }

    Subject plain = random_subject(random, 10, 1, 8, 9, 0);
    plain.tangents.clear();
    const fit::Bound without = fit::bind(plain.geometry(), plain.cylinder);
    DeformJob job = good;
    job.body = &without.body;
    CHECK(bend::validate(job) == JobFault::body_without_tangents);
}

TEST_CASE("P7: validate names the field at fault of packed vertices and of previous positions") {
    Random random(12);
    const bend::Body body = loose_body(random, 20);
    Output out(20);
    std::vector<bend::PackedVertex> vertices(21);
    using bend::DeformJob;
    using bend::JobFault;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto fault = [](DeformJob job, auto change) {
        change(job);
        return bend::validate(job);
    };

    DeformJob packed{.body = &body};
    packed.packed = {vertices.data(), sizeof(bend::PackedVertex), 20};
    CHECK(bend::validate(packed) == JobFault::none);
    CHECK(fault(packed, [](DeformJob& j) { j.packed.count = 19; }) == JobFault::packed_count);
    CHECK(fault(packed, [](DeformJob& j) { j.packed.stride = 8; }) == JobFault::packed_stride);
    CHECK(fault(packed, [](DeformJob& j) { j.packed.stride = 0; }) == JobFault::packed_stride);
    CHECK(fault(packed, [](DeformJob& j) { j.packed.stride = 14; }) == JobFault::packed_stride);
    CHECK(fault(packed, [](DeformJob& j) { j.packed.stride = 16; }) == JobFault::none);
    CHECK(fault(packed, [&](DeformJob& j) {
              j.packed.first = reinterpret_cast<bend::PackedVertex*>(&vertices[0].position[1]);
          }) == JobFault::packed_first);
    bend::Bounds box;
    CHECK(fault(packed, [&](DeformJob& j) { j.packed = {}, j.bounds = &box; }) == JobFault::no_streams);

    DeformJob previous{.body = &body};
    previous.previous_positions = planar(out.columns[0], out.columns[1], out.columns[2]);
    CHECK(bend::validate(previous) == JobFault::none);
    CHECK(fault(previous, [&](DeformJob& j) { j.previous_pose.angle = nan; }) ==
          JobFault::previous_pose_angle);
    CHECK(fault(previous, [&](DeformJob& j) { j.previous_pose.direction = nan; }) ==
          JobFault::previous_pose_direction);
    CHECK(fault(previous, [&](DeformJob& j) { j.previous_transform[3][1] = nan; }) ==
          JobFault::previous_transform);
    CHECK(fault(previous, [](DeformJob& j) { --j.previous_positions.count; }) ==
          JobFault::previous_positions_count);
    CHECK(fault(previous, [](DeformJob& j) { j.previous_positions.stride = 10; }) ==
          JobFault::previous_positions_stride);
    CHECK(fault(previous, [&](DeformJob& j) {
              j.previous_positions = interleaved<3>(out.columns[0].data(), 20, 8);
          }) == JobFault::previous_positions_stride);
    CHECK(fault(previous, [](DeformJob& j) { j.previous_positions.component[1] = nullptr; }) ==
          JobFault::previous_positions_component);
    // What is not asked for need not make sense.
    CHECK(fault(packed, [&](DeformJob& j) {
              j.previous_pose.angle = nan, j.previous_transform[0][0] = nan;
          }) == JobFault::none);
}

TEST_CASE("every fault has a line of its own, which begins with the field") {
    constexpr auto last = static_cast<int>(bend::JobFault::previous_poses_count);
    std::vector<std::string_view> lines;
    for (int i = 0; i <= last; ++i) {
        const std::string_view line = bend::describe(static_cast<bend::JobFault>(i));
        CAPTURE(line);
        CHECK(line != "unknown fault");
        CHECK(std::ranges::find(lines, line) == lines.end());
        const std::size_t colon = line.find(": ");
        CHECK((i == 0) == (colon == std::string_view::npos));
        CHECK((i == 0 || (colon > 2 && colon + 2 < line.size())));
        CHECK(line.back() != '.');
        lines.push_back(line);
    }
    CHECK(bend::describe(static_cast<bend::JobFault>(last + 1)) == "unknown fault");
}

TEST_CASE("angles and directions of any finite size give finite results") {
    Random random(11);
    const fit::Bound bound = bound_body(random);
    Output out(bound.body.vertex_count());
    for (const float angle : {1e-38f, -1e-38f, 1e-45f, 1e38f, -1e38f}) {
        for (const float direction : {0.0f, 1e30f, -1e-30f}) {
            for (const Isa isa : built_isas()) {
                if (!runs_here(isa)) continue;
                bend::run(make_job(bound.body, {angle, direction}, isa, out));
                for (std::size_t c = 0; c < 9; ++c) {
                    for (const float value : out.columns[c]) REQUIRE(std::isfinite(value));
                }
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
