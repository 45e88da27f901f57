// SPDX-License-Identifier: MIT
#include "support/bound_case.hpp"
#include "support/chain_checks.hpp"
#include "support/rounds.hpp"
#include "support/worst.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <string>

/// Bodies of several regions, and bodies bent at rest: P1, P2, P4, P5, P8, P9 and P10 of them.

namespace goffer::test {

TEST_CASE("P1, P2, P4: regions agree with the double chain") {
    Random random(61);
    Worst worst;
    for (int trial = 0; trial < rounds(16, 6); ++trial) {
        const std::size_t regions = 2 + random() % 7;
        CAPTURE(trial);
        CAPTURE(regions);
        const BoundCase one = random_case(random, regions, false);
        check_rest(one);
        worst.add(worst_of(random, one, 5e-6, 0.01));
    }
    MESSAGE("position ", worst.position, " L, normal ", worst.normal, " deg, tangent ", worst.tangent,
            " deg");
}

TEST_CASE("P1, P2, P4: bodies bent at rest agree with the double closed form") {
    Random random(62);
    Worst worst;
    for (int trial = 0; trial < rounds(16, 6); ++trial) {
        CAPTURE(trial);
        const BoundCase one = random_case(random, 1 + random() % 3, true);
        check_rest(one);
        worst.add(worst_of(random, one, 5e-6, 0.01));
    }
    MESSAGE("position ", worst.position, " L, normal ", worst.normal, " deg, tangent ", worst.tangent,
            " deg");
}

TEST_CASE("P1, P2, P4: bodies bent at rest along chains of arcs agree with the double chain") {
    Random random(64);
    Worst worst;
    for (int trial = 0; trial < rounds(16, 6); ++trial) {
        CAPTURE(trial);
        fit::BindOptions options;
        options.profile = random_profile(random);
        options.folds = static_cast<int>(random() % 5);
        const BoundCase one = random_arcs(random, 2 + random() % 5, options);
        check_rest(one);
        worst.add(worst_of(random, one, 5e-6, 0.05));  // as with an onset, which it has
    }
    MESSAGE("position ", worst.position, " L, normal ", worst.normal, " deg, tangent ", worst.tangent,
            " deg");
}

TEST_CASE("an onset agrees with the double closed form") {
    Random random(63);
    for (int trial = 0; trial < 6; ++trial) {
        const TestMesh test_mesh = random_mesh(random, uniform(random, 8, 30), 1);
        fit::BindOptions options;
        options.folds = 1 + static_cast<int>(random() % 6);
        options.onset = std::pow(10, uniform(random, -4, -1));
        CAPTURE(*options.onset);
        BoundCase one{test_mesh, options, fit::bind(test_mesh.geometry(), test_mesh.cylinder, options)};
        check_rest(one);
        worst_of(random, one, 5e-6, 0.05);
    }
}

TEST_CASE("P9: two regions of the same curvature and direction are one of the summed length") {
    Random random(64);
    const TestMesh test_mesh = random_mesh(random, 12, 1);
    fit::BindOptions one, two;
    one.folds = two.folds = 0;
    two.regions = {{0.37, {}}, {0.63, {}}};
    const fit::Binding whole = fit::bind(test_mesh.geometry(), test_mesh.cylinder, one);
    const fit::Binding parts = fit::bind(test_mesh.geometry(), test_mesh.cylinder, two);
    check_is_one_region(whole, parts, 3e-4);
}

TEST_CASE("regions meet: positions, and the tangent planes of the bare bend") {
    // Each vertex twice: as the end of one region, and as the beginning of the next.
    Random random(65);
    const double length = 0.5, radius = 0.1;
    const bend::WrinkleTable table =
        fit::make_wrinkle_table(paper::Profile::damped, paper::Amplitude::paper, 3, length, radius, 2);
    constexpr std::size_t around = 32;
    std::vector<bend::RestVertex> vertices;
    for (const double z : {length, 0.0}) {
        for (std::size_t i = 0; i < around; ++i) {
            const double beta = 2 * std::numbers::pi * static_cast<double>(i) / around;
            const double slope = paper::shape_slope_z(paper::Profile::damped, 3, length, z);
            vertices.push_back({beta, z, radius, 0, slope});  // g is 0 at both ends
        }
    }
    const std::vector<bend::RestVector> normals(vertices.size(), {1, 0, 0});
    const bend::RegionInput regions[] = {
        {.length = length, .max_angle = 2, .table = table, .vertex_count = around},
        {.length = length, .max_angle = 2, .table = table, .vertex_count = around}};
    bend::BodyInput input;
    input.radius = radius;
    input.regions = regions;
    input.vertices = vertices;
    input.normals = normals;
    const std::optional<bend::Body> body = bend::Body::make(input);
    REQUIRE(body);
    Output out(vertices.size());
    for (const Isa isa : isas_here()) {
        for (int trial = 0; trial < 50; ++trial) {
            const std::vector<bend::Pose> poses = random_poses(random, *body);
            bend::DeformJob job = make_job(*body, poses, isa, out);
            for (const float weight : {1.0f, 0.0f}) {
                job.wrinkle_weight = weight;
                bend::run(job);
                for (std::size_t i = 0; i < around; ++i) {
                    REQUIRE(glm::length(out.position(i) - out.position(around + i)) < 1e-6);
                    if (weight == 0) REQUIRE(angle_between(out.normal(i), out.normal(around + i)) < 2e-4);
                }
            }
        }
    }
}

TEST_CASE("P8: turning all directions and the body's vertices turns the result") {
    Random random(66);
    const double turn = 0.9;
    for (const bool bent : {false, true}) {
        TestMesh test_mesh = random_mesh(random, 15, 1);
        if (bent) test_mesh = bent_at_rest(test_mesh, 0.8, 0.4);
        const fit::BindOptions options = random_regions(random, 4);
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        TestMesh turned = test_mesh;  // the same mesh, told of in a frame turned about the axis
        const glm::dvec3 e2 = glm::cross(test_mesh.cylinder.axis, test_mesh.cylinder.zero);
        turned.cylinder.zero = std::cos(turn) * test_mesh.cylinder.zero + std::sin(turn) * e2;
        turned.cylinder.rest_direction -= turn;
        const fit::Binding other = fit::bind(turned.geometry(), turned.cylinder, options);
        const std::size_t count = test_mesh.positions.size();
        Output a(count), b(count);
        for (const Isa isa : isas_here()) {
            std::vector<bend::Pose> poses = random_poses(random, binding.body);
            bend::run(make_job(binding.body, poses, isa, a));
            for (bend::Pose& pose : poses) pose.direction -= static_cast<float>(turn);
            bend::run(make_job(other.body, poses, isa, b));
            for (std::size_t i = 0; i < count; ++i)
                REQUIRE(glm::length(a.position(i) - b.position(i)) < 1e-6);
        }
    }
}

TEST_CASE("P3: squeezed columns keep the lengths that they have at rest, region by region") {
    constexpr std::size_t rows = 4001, columns = 12;
    for (const double rest : {0.0, 0.6}) {
        TestMesh test_mesh;
        test_mesh.cylinder.length = 20;
        test_mesh.cylinder.radius = 1;
        for (std::size_t column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * static_cast<double>(column) / columns;
            for (std::size_t row = 0; row < rows; ++row) {
                test_mesh.positions.emplace_back(std::cos(beta), std::sin(beta),
                                                 20 * static_cast<double>(row) / (rows - 1));
                test_mesh.normals.emplace_back(std::cos(beta), std::sin(beta), 0);
                test_mesh.tangents.emplace_back(0, 0, 1, 1);
            }
        }
        test_mesh.triangles = {0, 1, rows, 0, 3 * rows, 6 * rows + 1};
        if (rest != 0) test_mesh = bent_at_rest(test_mesh, rest, 0.5);
        fit::BindOptions options;
        options.folds = 6;
        options.profile = paper::Profile::damped;
        options.onset = 0;  // which costs some length
        options.regions = {{0.5, {}}, {0.5, {}}};
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        const std::size_t count = test_mesh.positions.size();
        const std::vector<std::uint32_t> place = binding.vertices_in_body();
        const bend::Pose poses[] = {{1.2f, 0.5f}, {2.5f, 1.4f}};
        Output bent(count);
        bend::run(make_job(binding.body, poses, Isa::automatic, bent));
        for (std::size_t column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * static_cast<double>(column) / columns;
            double expected = 0;
            for (const bend::Pose& pose : poses) {
                const auto angle = static_cast<double>(pose.angle);
                const double at_rest = 1 - rest / 2 / 10 * (1 + std::cos(beta - 0.5));
                const double now =
                    1 - angle / 10 * (1 + std::cos(beta - static_cast<double>(pose.direction)));
                expected += 10 * std::max(at_rest, now);
            }
            double length = 0;
            for (std::size_t row = 1; row < rows; ++row) {
                const std::size_t i = place[column * rows + row], j = place[column * rows + row - 1];
                length += glm::length(bent.position(i) - bent.position(j));
            }
            CAPTURE(beta);
            CHECK(std::fabs(length - expected) < 4e-4 * 20);
        }
    }
}

TEST_CASE("P5: ranges, pieces and crowds of regions give the same bits") {
    Random random(67);
    for (const bool bent : {false, true}) {
        for (const std::size_t regions : {std::size_t{5}, std::size_t{1}}) {
            const BoundCase one = random_case(random, regions, bent);
            const std::size_t count = one.test_mesh.positions.size();
            const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
            for (const Isa isa : isas_here()) {
                for (const bool directions : {true, false}) {
                    const auto job_to = [&](Output& out) {
                        bend::DeformJob job = make_job(one.binding.body, poses, isa, out);
                        if (!directions) job.normals = {}, job.tangents = {};
                        return job;
                    };
                    Output whole(count), parts(count);
                    const auto same = [&] {
                        for (std::size_t c = 0; c < 10; ++c)
                            if (!std::ranges::equal(whole.columns[c], parts.columns[c])) return false;
                        return true;
                    };
                    bend::run(job_to(whole));
                    for (std::size_t first = 0; first < count;) {
                        const std::size_t last = std::min(count, first + 1 + random() % 400);
                        bend::run_range(job_to(parts), first, last);
                        first = last;
                    }
                    CHECK(same());
                    for (const bend::Stores stores : {bend::Stores::cached, bend::Stores::non_temporal}) {
                        parts = Output(count);
                        bend::DeformJob job = job_to(parts);
                        bend::Batch batch = bend::batch_of(job);
                        const bend::CrowdJob crowd{.batches = {&batch, 1}, .stores = stores, .isa = isa};
                        bend::run_parallel(crowd);
                        CHECK(same());
                        parts = Output(count);
                        job = job_to(parts);
                        batch = bend::batch_of(job);
                        for (std::size_t piece = 0; piece < 3; ++piece) bend::run_piece(crowd, piece, 3);
                        CHECK(same());
                    }
                }
            }
        }
    }
}

TEST_CASE("streams that have no kernel of their own have the bits of those that have") {
    Random random(68);
    for (const bool bent : {false, true}) {
        const BoundCase one = random_case(random, 2, bent);
        const std::size_t count = one.test_mesh.positions.size();
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        for (const Isa isa : isas_here()) {
            for (const float weight : {1.0f, 0.3f, 0.0f}) {
                Output all(count);
                bend::DeformJob job = make_job(one.binding.body, poses, isa, all);
                job.wrinkle_weight = weight;
                bend::run(job);
                for (unsigned streams = 1; streams < 7; ++streams) {
                    Output some(count);
                    job = make_job(one.binding.body, poses, isa, some);
                    job.wrinkle_weight = weight;
                    if ((streams & 1) == 0) job.positions = {};
                    if ((streams & 2) == 0) job.normals = {};
                    if ((streams & 4) == 0) job.tangents = {};
                    bend::run(job);
                    for (std::size_t c = 0; c < 10; ++c) {
                        const bool wanted = ((streams >> std::min<std::size_t>(c / 3, 2)) & 1) != 0;
                        if (wanted) REQUIRE(std::ranges::equal(some.columns[c], all.columns[c]));
                    }
                }
            }
        }
    }
}

TEST_CASE("P10: bounds hold the vertices of chains and of bodies bent at rest") {
    Random random(70);
    for (int trial = 0; trial < 40; ++trial) {
        const BoundCase one = random_case(random, 1 + random() % 6, trial % 2 == 0);
        const std::size_t count = one.test_mesh.positions.size();
        Output out(count);
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        const bend::DeformJob job = make_job(one.binding.body, poses, Isa::automatic, out);
        bend::run(job);
        const bend::Bounds box = bend::bounds(job);
        const bend::Bounds same = bend::bounds(one.binding.body, poses);
        CHECK(box.low == same.low);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p(out.position(i));
            REQUIRE(glm::all(glm::lessThanEqual(box.low, p)));
            REQUIRE(glm::all(glm::lessThanEqual(p, box.high)));
        }
    }
}

TEST_CASE("P10: bounds hold bodies whose onset takes most of their wrinkles, and are not much larger") {
    Random random(71);
    float most = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const TestMesh test_mesh = random_mesh(random, uniform(random, 8, 30), 1);
        fit::BindOptions options;
        options.folds = 1 + static_cast<int>(random() % 6);
        options.onset = std::pow(10, uniform(random, -2, 0));
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        const std::size_t count = test_mesh.positions.size();
        Output out(count);
        const std::vector<bend::Pose> poses = random_poses(random, binding.body);
        const bend::DeformJob job = make_job(binding.body, poses, Isa::automatic, out);
        bend::run(job);
        const bend::Bounds box = bend::bounds(job);
        glm::vec3 low(out.position(0)), high = low;
        for (std::size_t i = 0; i < count; ++i) {
            low = glm::min(low, glm::vec3(out.position(i)));
            high = glm::max(high, glm::vec3(out.position(i)));
        }
        CAPTURE(*options.onset);
        CHECK(glm::all(glm::lessThanEqual(box.low, low)));
        CHECK(glm::all(glm::lessThanEqual(high, box.high)));
        for (int axis = 0; axis < 3; ++axis)
            test::take_worst(most, (box.high[axis] - box.low[axis]) / (high[axis] - low[axis]));
    }
    MESSAGE("at most ", most, " times as long");
    CHECK(most < 1.7f);
}

TEST_CASE("a chain is clamped where any region is") {
    Random random(72);
    const BoundCase one = random_case(random, 3, false);
    Output out(one.test_mesh.positions.size());
    std::vector<bend::Pose> poses(3);
    CHECK_FALSE(bend::run(make_job(one.binding.body, poses, Isa::automatic, out)).clamped);
    poses[1].angle = 1.01f * one.binding.body.max_angle(1);
    CHECK(bend::run(make_job(one.binding.body, poses, Isa::automatic, out)).clamped);
}

}  // namespace goffer::test
