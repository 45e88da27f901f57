// SPDX-License-Identifier: MIT
#include "capsules.hpp"
#include "support/arena.hpp"
#include "support/bodies.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

/// Property P10: bounds from the pose alone hold every vertex, and not much more.

namespace goffer::test {
namespace {

/// The box around the positions in `out`.
bend::Bounds tight(const Output& out) {
    bend::Bounds box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto values = out.columns[static_cast<std::size_t>(axis)];
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        box.low[axis] = *low;
        box.high[axis] = *high;
    }
    return box;
}

bool holds(const bend::Bounds& outer, const bend::Bounds& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(outer.low[axis] <= inner.low[axis] && inner.high[axis] <= outer.high[axis])) return false;
    }
    return true;
}

bool same_box(const bend::Bounds& a, const bend::Bounds& b) {
    return a.low == b.low && a.high == b.high;
}

/// Any angle: tiny ones, the largest, and beyond it.
bend::Pose random_pose_of(Random& random, const bend::Body& body) {
    const auto limit = static_cast<double>(body.max_angle());
    const double kind = uniform(random, 0, 1);
    const double angle = kind < 0.15  ? std::pow(10, uniform(random, -9, 0))
                         : kind < 0.3 ? limit * uniform(random, 0.99, 1.3)
                                      : uniform(random, 0, limit);
    return {static_cast<float>(random() % 3 == 0 ? -angle : angle),
            static_cast<float>(uniform(random, -9, 9))};
}

/// `area` only where folds are shallow, as in accuracy.cpp.
fit::BindOptions random_coarse_options(Random& random, const fit::Cylinder& cylinder) {
    fit::BindOptions options;
    options.folds = static_cast<int>(random() % 13);
    options.profile = random_profile(random);
    const bool shallow = *options.folds * 4 * cylinder.radius >= cylinder.length && *options.folds >= 3 &&
                         options.profile.kind != paper::Profile::Kind::even && cylinder.radii.empty();
    if (shallow && random() % 2 == 0) options.amplitude = paper::Amplitude::area;
    options.table_rows = 64;
    return options;
}

void check_held(Random& random, const bend::Body& body, int poses) {
    Output out(body.vertex_count());
    for (int k = 0; k < poses; ++k) {
        const bend::Pose pose = random_pose_of(random, body);
        bend::DeformJob job = make_job(body, pose, Isa::automatic, out);
        job.normals = {};
        job.tangents = {};
        if (k % 4 != 0) job.transform = random_transform(random, k % 4 == 1 ? 0 : 30 * body.length());
        const bend::Bounds box = bend::bounds(job);
        std::vector<bend::Capsule> chain(1 + random() % 20);
        bend::capsules(job, chain.size(), chain);
        INFO("angle ", pose.angle, " of ", body.max_angle(), " direction ", pose.direction, " L/r ",
             body.length() / body.radius());
        for (const Isa isa : isas_here()) {
            CAPTURE(name(isa));
            job.isa = isa;
            bend::run(job);
            REQUIRE(holds(box, tight(out)));
            for (std::size_t v = 0; v < body.vertex_count(); ++v) REQUIRE(hold(chain, out.position(v)));
        }
    }
}

/// A body of revolution: `radius(u)` of the height's share 0..1, of 1 at most, with flat caps or without.
struct Round {
    std::string name;
    std::function<double(double)> radius;
    bool caps;
};

const Round round_bodies[] = {
    {"cylinder", [](double) { return 1.0; }, false},
    {"capped cylinder", [](double) { return 1.0; }, true},
    {"tapered", [](double u) { return 1 - 0.7 * u; }, false},
    {"cone", [](double u) { return 1 - u; }, false},
    {"bulged", [](double u) { return 1 - 0.6 * (2 * u - 1) * (2 * u - 1); }, true},
    {"ball", [](double u) { return std::sqrt(std::max(0.0, 1 - (2 * u - 1) * (2 * u - 1))); }, false},
    {"waisted", [](double u) { return 0.4 + 0.6 * (2 * u - 1) * (2 * u - 1); }, true},
};

TestMesh round_mesh(const Round& round, double slenderness, const glm::dmat3& axes) {
    constexpr int columns = 36, rows = 129;
    TestMesh test_mesh;
    fit::Cylinder& c = test_mesh.cylinder;
    c.length = 1;
    c.axis = axes[2];
    c.zero = axes[0];
    double mean = 0;
    for (int row = 0; row < rows; ++row) mean += round.radius(row / (rows - 1.0)) / rows;
    c.radius = 1 / slenderness;
    const auto ring = [&](double z, double rho) {
        for (int column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * column / columns;
            test_mesh.positions.emplace_back(axes *
                                             glm::dvec3(rho * std::cos(beta), rho * std::sin(beta), z));
        }
    };
    for (int row = 0; row < rows; ++row)
        ring(row / (rows - 1.0), c.radius / mean * round.radius(row / (rows - 1.0)));
    if (round.caps) {
        for (const double share : {0.75, 0.5, 0.25, 0.0}) {
            ring(0, share * c.radius / mean * round.radius(0));
            ring(1, share * c.radius / mean * round.radius(1));
        }
    }
    for (std::uint32_t i = 0; i + columns + 1 < rows * columns; ++i)
        test_mesh.triangles.insert(test_mesh.triangles.end(), {i, i + 1, i + columns});
    return test_mesh;
}

}  // namespace

TEST_CASE("P10: bounds and capsules hold every vertex") {
    Random random(81);
    for (int trial = 0; trial < rounds(40, 10); ++trial) {
        const double slenderness =
            trial % 4 == 0 ? std::pow(10, uniform(random, 1.5, 3)) : uniform(random, 3, 40);
        TestMesh test_mesh =
            random_mesh(random, slenderness, std::pow(10, uniform(random, -3, 3)), 12, 49, 150);
        if (trial % 3 == 0) add_radii(test_mesh, random);
        const fit::BindOptions options = random_coarse_options(random, test_mesh.cylinder);
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        INFO("trial ", trial, " folds ", binding.folds());
        check_held(random, binding.body, 50);
    }
}

TEST_CASE("P10: bounds and capsules hold any body, however far out its vertices and deep its wrinkles") {
    Random random(82);
    for (int trial = 0; trial < rounds(150, 30); ++trial) {
        const std::size_t count = trial % 5 == 0 ? 1 + random() % 4 : 300;
        const double widest = trial % 3 == 0 ? 0.11 : uniform(random, 0.01, 2);
        check_held(random, loose_body(random, count, widest), 25);
        check_held(random, loose_shaped_body(random, count, widest), 25);
    }
}

TEST_CASE("P10: bounds hold every vertex under transforms of any size") {
    Random random(107);
    const auto power = [&](double most) {
        return static_cast<float>(std::pow(10, uniform(random, -most, most)));
    };
    for (int round = 0; round < rounds(20000, 2000); ++round) {
        const std::vector<std::size_t> counts(1 + random() % 4, 20);
        const bend::Body body = loose_chain(random, counts);
        Output out(body.vertex_count());
        for (int k = 0; k < 20; ++k) {
            std::vector<bend::Pose> poses;
            for (std::size_t r = 0; r < counts.size(); ++r)
                poses.push_back(
                    {static_cast<float>(uniform(random, -5, 5)), static_cast<float>(uniform(random, -4, 4))});
            bend::DeformJob job =
                make_job(body, bend::Pose{}, isas_here()[random() % isas_here().size()], out);
            job.poses = poses;
            job.normals = {};
            job.tangents = {};
            job.transform = random_transform(random, 1);
            const float size = power(30);
            for (int c = 0; c < 3; ++c) job.transform[c] *= size * (random() % 3 == 0 ? power(3) : 1.0f);
            job.transform[3] *= power(30);
            const bend::Bounds box = bend::bounds(job);
            bend::run(job);
            INFO("round ", round, ", size ", size, ", ", name(job.isa));
            REQUIRE(holds(box, tight(out)));
        }
    }
}

TEST_CASE("P10: bounds are at most 1.3 times as long as the tight box on each axis for round bodies") {
    Random random(83);
    double worst[2] = {};  // shallow folds or none; folds deeper than the radius
    std::string where[2];
    for (const Round& round : round_bodies) {
        for (int trial = 0; trial < rounds(12, 4); ++trial) {
            const double slenderness =
                trial % 4 == 0 ? std::pow(10, uniform(random, 1.5, 2.5)) : uniform(random, 3, 40);
            const glm::dmat3 axes = trial % 3 == 0 ? glm::dmat3(1) : random_rotation(random);
            const TestMesh test_mesh = round_mesh(round, slenderness, axes);
            const fit::BindOptions options = random_coarse_options(random, test_mesh.cylinder);
            const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
            const bool deep = *options.folds > 0 && *options.folds * 4 < slenderness;
            Output out(test_mesh.positions.size());
            for (int k = 0; k < 30; ++k) {
                bend::Pose pose = random_pose_of(random, binding.body);
                // Beyond, the vertices are too few for a tight box.
                pose.angle = std::clamp(pose.angle, -40.0f, 40.0f);
                bend::DeformJob job = make_job(binding.body, pose, Isa::automatic, out);
                job.normals = {};
                if (k % 2 == 1) {
                    const glm::mat3 turn(random_rotation(random));
                    job.transform = {turn[0], turn[1], turn[2], glm::vec3(0)};
                }
                bend::run(job);
                const bend::Bounds box = bend::bounds(job), least = tight(out);
                INFO(round.name, ", L/r ", slenderness, ", folds ", binding.folds(), ", angle ", pose.angle);
                REQUIRE(holds(box, least));
                for (int axis = 0; axis < 3; ++axis) {
                    const double ratio = static_cast<double>(box.high[axis] - box.low[axis]) /
                                         static_cast<double>(least.high[axis] - least.low[axis]);
                    CHECK(ratio <= (deep ? 1.7 : 1.3));
                    if (ratio <= worst[deep]) continue;
                    worst[deep] = ratio;
                    where[deep] = round.name + ", L/r " + std::to_string(slenderness) + ", folds " +
                                  std::to_string(binding.folds()) + ", angle " + std::to_string(pose.angle);
                }
            }
        }
    }
    MESSAGE("worst ", worst[0], ": ", where[0]);
    MESSAGE("with folds deeper than the radius ", worst[1], ": ", where[1]);
}

TEST_CASE("every way to run a job leaves the same bounds") {
    Random random(84);
    std::vector<bend::Body> bodies;
    bodies.push_back(loose_body(random, 60));
    bodies.push_back(loose_body(random, 3000));
    std::vector<bend::DeformJob> jobs;
    std::vector<bend::Bounds> boxes(12), expected(12);
    std::vector<Columns> outputs;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const bend::Body& body = bodies[i / 3 % 2];
        Columns& out = outputs.emplace_back(3, body.vertex_count());
        bend::DeformJob job{.body = &body, .pose = random_pose_of(random, body)};
        job.transform = random_transform(random, 3);
        job.positions = planar(out[0], out[1], out[2]);
        if (i % 5 != 0) job.bounds = &boxes[i];
        jobs.push_back(job);
        expected[i] = bend::bounds(body, job.pose, job.transform);
        CHECK(same_box(expected[i], bend::bounds(job)));
    }
    bend::bounds(jobs, boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) CHECK(same_box(boxes[i], expected[i]));
    const auto check = [&](auto run) {
        boxes.assign(boxes.size(), {glm::vec3(7), glm::vec3(-7)});
        run();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            CHECK(same_box(boxes[i], i % 5 == 0 ? bend::Bounds{glm::vec3(7), glm::vec3(-7)} : expected[i]));
    };
    std::vector<bend::Batch> batches;
    for (const bend::DeformJob& job : jobs) batches.push_back(bend::batch_of(job));
    const bend::CrowdJob crowd{.batches = batches};
    check([&] {
        for (const bend::DeformJob& job : jobs) bend::run(job);
    });
    check([&] {
        for (const bend::DeformJob& job : jobs) in_arena(3, [&] { bend::run_parallel(job, 64); });
    });
    check([&] {
        for (const bend::DeformJob& job : jobs) {
            bend::run_range(job, 0, 7);  // this one; the others must not touch them
            if (job.bounds == nullptr) continue;
            const bend::Bounds left = *job.bounds;
            *job.bounds = {};
            bend::run_range(job, 7, job.body->vertex_count());
            CHECK(same_box(*job.bounds, {}));
            *job.bounds = left;
        }
    });
    check([&] { bend::run(crowd); });
    for (const int threads : {1, 2, 4}) check([&] { in_arena(threads, [&] { bend::run_parallel(crowd); }); });
    for (const std::size_t pieces : {1u, 2u, 13u, 500u}) {
        check([&] {
            for (std::size_t piece = pieces; piece-- > 0;) bend::run_piece(crowd, piece, pieces);
        });
    }
}

}  // namespace goffer::test
