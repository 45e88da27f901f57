// SPDX-License-Identifier: MIT
#include "capsules.hpp"
#include "curves.hpp"
#include "support/chains.hpp"
#include "support/worst.hpp"

#include <goffer/bend/path.hpp>
#include <goffer/bend/sockets.hpp>
#include <goffer/fit/sockets.hpp>

#include <doctest/doctest.h>

#include <limits>

/// What follows a body without its mesh: sockets, capsules; poses along a path.

namespace goffer::test {
namespace {

/// A body of regions, bent at rest or not, and poses of it.
struct Chain {
    TestMesh test_mesh;
    fit::Binding binding;
    std::vector<bend::Pose> poses;
};

Chain random_chain(Random& random, std::size_t regions, bool bent) {
    TestMesh test_mesh = random_mesh(random, uniform(random, 10, 20), 1);
    if (random() % 2 == 0 && !(bent && regions > 1)) add_radii(test_mesh, random);
    if (bent) test_mesh = bent_at_rest(test_mesh, uniform(random, 0.2, 1.5), uniform(random, -3, 3));
    fit::BindOptions options;
    options.folds = 3;
    for (std::size_t i = 0; i < regions; ++i)
        options.regions.push_back({1.0 / static_cast<double>(regions), std::nullopt});
    fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    std::vector<bend::Pose> poses;
    for (const bend::Region& region : binding.body.regions()) {
        poses.push_back({static_cast<float>(uniform(random, 0, 0.9 * static_cast<double>(region.max_angle))),
                         static_cast<float>(uniform(random, -3, 3))});
    }
    return {std::move(test_mesh), std::move(binding), std::move(poses)};
}

std::uint32_t vertex_of_mesh(const Chain& chain, std::size_t vertex) {
    return chain.binding.order.empty() ? static_cast<std::uint32_t>(vertex) : chain.binding.order[vertex];
}

}  // namespace

TEST_CASE("a socket goes where the vertex at its place goes") {
    Random random(81);
    for (int trial = 0; trial < 10; ++trial) {
        const Chain chain = random_chain(random, 1 + random() % 4, trial % 2 == 0);
        const TestMesh& s = chain.test_mesh;
        const std::size_t count = s.positions.size();
        const glm::dmat3 axes(s.cylinder.zero, glm::cross(s.cylinder.axis, s.cylinder.zero), s.cylinder.axis);
        std::vector<bend::Socket> sockets;
        std::vector<std::size_t> vertices;
        for (int i = 0; i < 100; ++i) {  // in any order of the regions
            const std::size_t vertex = random() % count;
            const paper::Cylindrical at = paper::to_cylindrical(
                glm::transpose(axes) *
                    (glm::dvec3(s.positions[vertex_of_mesh(chain, vertex)]) - s.cylinder.origin),
                s.cylinder.length, s.cylinder.radius, {s.cylinder.rest_angle, s.cylinder.rest_direction});
            sockets.push_back(
                fit::socket_at(chain.binding, std::clamp(at.z, 0.0, s.cylinder.length), at.beta, at.rho));
            vertices.push_back(vertex);
        }
        const std::optional<bend::Sockets> made = bend::Sockets::make(chain.binding.body, sockets);
        REQUIRE(made);
        REQUIRE(made->count() == sockets.size());
        const glm::mat4x3 transform = random_transform(random, 1);
        double size = 0;
        for (int c = 0; c < 3; ++c) size = std::max(size, static_cast<double>(glm::length(transform[c])));
        Output out(count);
        bend::DeformJob job = make_job(chain.binding.body, {}, Isa::automatic, out);
        job.poses = chain.poses;
        job.transform = transform;
        bend::run(job);
        std::vector<bend::SocketFrame> frames(sockets.size()), same(sockets.size());
        made->frames(job, frames);
        made->frames(chain.poses, same, transform);
        for (std::size_t i = 0; i < sockets.size(); ++i) {
            REQUIRE(glm::length(glm::dvec3(frames[i][3]) - out.position(vertices[i])) < 2e-6 * size);
            REQUIRE(frames[i][3] == same[i][3]);
            const glm::dmat3 a{glm::mat3(frames[i])};
            const glm::dmat3 unit = glm::transpose(a) * a;
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) REQUIRE(std::fabs(unit[c][r] - (c == r)) < 2e-6);
            REQUIRE(glm::determinant(a) > 0.99);
        }
    }
}

TEST_CASE("the socket nearest to a point lies on the surface there, its axis along the normal") {
    Random random(82);
    for (const bool bent : {false, true}) {
        const Chain chain = random_chain(random, 2, bent);
        const TestMesh& s = chain.test_mesh;
        for (int trial = 0; trial < 20; ++trial) {
            // Off a triangle's middle, along its normal.
            const std::size_t t = random() % (s.triangles.size() / 3) * 3;
            glm::dvec3 corner[3];
            for (std::size_t i = 0; i < 3; ++i) corner[i] = s.positions[s.triangles[t + i]];
            const glm::dvec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
            const glm::dvec3 normal =
                glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
            const bend::Socket socket = fit::socket_near(chain.binding, s.geometry(), middle + 1e-5 * normal);
            const std::optional<bend::Sockets> made = bend::Sockets::make(chain.binding.body, {&socket, 1});
            REQUIRE(made);
            const std::vector<bend::Pose> rest = chain.binding.body.rest_poses();
            bend::SocketFrame frame;
            made->frames(rest, {&frame, 1});
            REQUIRE(glm::length(glm::dvec3(frame[3]) - middle) < 5e-7);
            REQUIRE(angle_between(glm::dvec3(frame[2]), normal) < 5e-5);
        }
    }
}

TEST_CASE("sockets that cannot be are refused") {
    Random random(83);
    const Chain chain = random_chain(random, 2, false);
    CHECK_THROWS_WITH_AS(static_cast<void>(fit::socket_at(chain.binding, 2, 0, 0.1)),
                         doctest::Contains("socket: z = 2"), fit::Error);
    CHECK_THROWS_AS(static_cast<void>(fit::socket_at(chain.binding, 0.5, 0, -1)), fit::Error);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(static_cast<void>(fit::socket_at(chain.binding, 0.5, nan, 0.1)), fit::Error);
    CHECK_THROWS_AS(
        static_cast<void>(fit::socket_near(chain.binding, chain.test_mesh.geometry(), glm::dvec3(nan, 0, 0))),
        fit::Error);
    bend::Socket socket = fit::socket_at(chain.binding, 0.5, 0, 0.1);
    socket.region = 2;
    CHECK_FALSE(bend::Sockets::make(chain.binding.body, {&socket, 1}));
}

TEST_CASE("capsules hold every vertex, and more of them fit closer") {
    Random random(84);
    double before[3] = {};
    for (int trial = 0; trial < 30; ++trial) {
        const Chain chain = random_chain(random, 1 + random() % 4, trial % 2 == 0);
        const std::size_t count = chain.test_mesh.positions.size();
        Output out(count);
        bend::DeformJob job = make_job(chain.binding.body, {}, Isa::automatic, out);
        job.poses = chain.poses;
        if (trial % 3 == 0) job.transform = random_transform(random, 1);
        if (trial % 5 == 0) job.transform[3] += glm::vec3(1e4, -3e3, 2e5);  // rounded to 0.015 there
        bend::run(job);
        std::size_t step = 0;
        for (const std::size_t pieces : {1u, 4u, 16u}) {
            std::vector<bend::Capsule> chain_of(bend::capsule_count(chain.binding.body, pieces));
            bend::capsules(job, pieces, chain_of);
            double widest = 0;
            for (const bend::Capsule& capsule : chain_of)
                widest = std::max(widest, static_cast<double>(capsule.radius));
            before[step++] += widest;
            for (std::size_t i = 0; i < count; ++i) REQUIRE(hold(chain_of, out.position(i)));
        }
    }
    CHECK(before[1] < before[0]);
    CHECK(before[2] <= before[1]);
}

TEST_CASE("capsules hold what wrinkles move through the axis, where no crest is near") {
    Random random(59);
    LooseVertices loose(random, 200, 0.1);
    for (bend::RestVertex& v : loose.vertices) v.wrinkle = -std::fabs(v.wrinkle);
    bend::RegionInput region = loose_region(loose.vertices.size());
    region.table =
        fit::make_wrinkle_table(paper::Profile::damped, paper::Amplitude::paper, 1, 1, 0.1, 4.9, 32);
    const bend::Body body = loose.body({&region, 1});
    Output out(body.vertex_count());
    const bend::DeformJob job = make_job(body, {body.max_angle(), 1}, Isa::automatic, out);
    bend::run(job);
    for (const std::size_t pieces : {1u, 4u, 40u}) {
        std::vector<bend::Capsule> chain(pieces);
        bend::capsules(job, pieces, chain);
        for (std::size_t v = 0; v < body.vertex_count(); ++v) REQUIRE(hold(chain, out.position(v)));
    }
}

TEST_CASE("capsules are no thicker than the body and the bulge of its arc") {
    Random random(58);
    std::vector<bend::RestVertex> vertices(200);
    for (bend::RestVertex& v : vertices)
        v = {.beta = uniform(random, -3, 3), .z = uniform(random, 0, 1), .rho = 0.1};
    const std::vector<bend::RestVector> normals(vertices.size(), {1, 0, 0});
    const bend::Body body = bare_body(vertices, normals);
    for (const float angle : {0.0f, 0.5f, 1.0f, 2.0f}) {
        for (const std::size_t pieces : {1u, 3u, 10u}) {
            std::vector<bend::Capsule> chain(pieces);
            bend::capsules({.body = &body, .pose = {angle, 1}}, pieces, chain);
            const double turn = static_cast<double>(angle) / static_cast<double>(pieces);
            const double arc = 1.0 / static_cast<double>(pieces);
            for (const bend::Capsule& capsule : chain)
                CHECK(static_cast<double>(capsule.radius) <= 0.1 + arc * turn / 8 + 1e-5);
        }
    }
}

TEST_CASE("poses along a path: the center line follows it, the better the more regions there are") {
    Random random(85);
    const TestMesh test_mesh = random_mesh(random, 30, 10, 12, 65, 0);
    const glm::vec3 control[4] = {{1, 2, 3}, {5, 2, 3}, {6, 7, 3}, {9, 5, 6}};  // about as long as the body
    const std::vector<glm::dvec3> line = line_of(control, 4000);
    double last = 2;
    for (const std::size_t regions : {2u, 4u, 8u, 16u}) {
        fit::BindOptions options;
        options.folds = 0;
        for (std::size_t i = 0; i < regions; ++i)
            options.regions.push_back({1.0 / static_cast<double>(regions), std::nullopt});
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        std::vector<bend::Pose> poses(regions);
        const bend::PathFit fit = bend::poses_along_bezier(binding.body, control, poses);
        CAPTURE(regions);
        CHECK_FALSE(fit.clamped);
        CHECK(fit.error > 0);
        CHECK(static_cast<double>(fit.error) < 0.45 * last);  // nearly a quarter each time
        last = static_cast<double>(fit.error);
        // What is said of the center line holds for what is deformed: sockets on the axis.
        std::vector<bend::Socket> sockets;
        for (int i = 0; i <= 50; ++i) sockets.push_back(fit::socket_at(binding, 0.2 * i, 0, 0));
        const std::optional<bend::Sockets> made = bend::Sockets::make(binding.body, sockets);
        REQUIRE(made);
        std::vector<bend::SocketFrame> frames(sockets.size());
        made->frames(poses, frames, fit.transform);
        CHECK(glm::length(frames[0][3] - control[0]) < 3e-6f);
        double worst = 0;
        for (const bend::SocketFrame& frame : frames)
            test::take_worst(worst, distance_to_polyline(glm::dvec3(frame[3]), line));
        CHECK(worst < 1.02 * static_cast<double>(fit.error) + 1e-3);
    }
    CHECK(last < 0.03);
}

TEST_CASE("paths that are none are named") {
    using bend::PathFault;
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), bad(0, std::numeric_limits<float>::infinity(), 0);
    const auto check = [](std::initializer_list<glm::vec3> points) {
        return bend::check_path(std::span(points.begin(), points.size()));
    };
    CHECK(check({a, b, a}) == PathFault::none);
    CHECK(check({a}) == PathFault::too_few_points);
    CHECK(check({a, bad}) == PathFault::not_finite);
    CHECK(check({a, b, b}) == PathFault::repeated_point);
    for (const PathFault fault :
         {PathFault::too_few_points, PathFault::not_finite, PathFault::repeated_point})
        CHECK(bend::describe(fault).starts_with("path: "));
}

}  // namespace goffer::test
