// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/fit/bake.hpp>
#include <goffer/fit/sockets.hpp>

#include <doctest/doctest.h>

#include <cstring>
#include <numeric>
#include <string>
#include <vector>

/// Baking: what was bound comes out of the file as it was, in the body's order.

namespace goffer::test {
namespace {

/// A bound mesh, with texture coordinates that say where they were.
struct Baked {
    TestMesh test_mesh;
    fit::Binding binding;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> source;

    [[nodiscard]] fit::BakeLevel level() const { return {&binding, {test_mesh.triangles, uvs, source, {}}}; }
};

Baked bound_mesh(TestMesh test_mesh, const fit::Binding* rig, const fit::BindOptions& options) {
    const fit::Geometry geometry = test_mesh.geometry();
    Baked baked{
        {}, rig ? fit::bind_level(geometry, *rig) : fit::bind(geometry, test_mesh.cylinder, options), {}, {}};
    for (std::uint32_t i = 0; i < test_mesh.positions.size(); ++i) {
        baked.uvs.emplace_back(static_cast<float>(i), -1.0f);
        baked.source.push_back(2 * i);
    }
    baked.test_mesh = std::move(test_mesh);
    return baked;
}

std::vector<glm::vec3> deformed_as_stored(const bend::Body& body, std::span<const bend::Pose> poses) {
    std::vector<glm::vec3> positions(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    return positions;
}

fit::BindOptions some_options(Random& random, std::size_t regions) {
    fit::BindOptions options;
    options.profile = random_profile(random);
    options.amplitude = random() % 2 == 0 ? fit::Amplitude::mesh : fit::Amplitude::paper;
    if (random() % 2 == 0) options.onset = 1e-3;
    for (std::size_t r = 0; r < regions; ++r)
        options.regions.push_back({1.0 / static_cast<double>(regions), {}});
    return options;
}

}  // namespace

TEST_CASE("bake: a body of fit's comes out as it was, with its triangles in the body's order") {
    Random random(61);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const std::size_t regions = round % 3 == 0 ? 1 : 3;
        const Baked fine =
            bound_mesh(random_mesh(random, 12, 2, 24, 65), nullptr, some_options(random, regions));
        const std::vector<fit::BakeLevel> levels{fine.level()};
        const bend::BodyFile file = bend::load_copy(fit::bake({levels})).value();
        const auto& [body, mesh, box] = file.levels.at(0);

        std::vector<bend::Pose> poses(regions, {0.7f, 1.0f});
        const std::vector<glm::vec3> was = deformed_as_stored(fine.binding.body, poses),
                                     is = deformed_as_stored(body, poses);
        CHECK(std::memcmp(was.data(), is.data(), was.size() * sizeof was[0]) == 0);

        const std::vector<std::uint32_t>& order = fine.binding.order;
        CHECK(order.empty() == (regions == 1));
        const std::vector<std::uint32_t> vertices = fine.binding.vertices_in_body();
        bool right = mesh.triangles.size() == fine.test_mesh.triangles.size();
        for (std::size_t i = 0; right && i < mesh.triangles.size(); ++i) {
            const std::uint32_t place = mesh.triangles[i];
            right = place == vertices[fine.test_mesh.triangles[i]] &&
                    (order.empty() ? place : order[place]) == fine.test_mesh.triangles[i] &&
                    mesh.source[place] == 2 * fine.test_mesh.triangles[i] &&
                    mesh.uvs[place].x == static_cast<float>(fine.test_mesh.triangles[i]);
        }
        CHECK(right);
        for (std::size_t i = 0; i < fine.test_mesh.positions.size(); ++i) {
            const glm::vec3& p = fine.test_mesh.positions[i];
            for (int c = 0; c < 3; ++c) {
                CHECK(p[c] > box.low[c] - 1e-5f);
                CHECK(p[c] < box.high[c] + 1e-5f);
            }
        }
    }
}

TEST_CASE("bake: levels of one rig, and sockets") {
    Random random(62);
    const TestMesh fine_mesh = random_mesh(random, 12, 2, 24, 65);
    TestMesh coarse_mesh = random_mesh(random, 12, 2, 12, 33);
    coarse_mesh.cylinder = fine_mesh.cylinder;
    const glm::dvec3 e2 = glm::cross(fine_mesh.cylinder.axis, fine_mesh.cylinder.zero);
    for (std::size_t i = 0; i < coarse_mesh.positions.size();
         ++i) {  // the random mesh has a frame of its own
        const double beta = 0.1 * static_cast<double>(i), z = 2 * static_cast<double>(i % 50) / 49;
        coarse_mesh.positions[i] =
            fine_mesh.cylinder.origin + z * fine_mesh.cylinder.axis +
            fine_mesh.cylinder.radius * (std::cos(beta) * fine_mesh.cylinder.zero + std::sin(beta) * e2);
    }
    const Baked fine = bound_mesh(fine_mesh, nullptr, some_options(random, 2));
    const Baked coarse = bound_mesh(std::move(coarse_mesh), &fine.binding, {});
    const std::vector<fit::BakeLevel> levels{fine.level(), coarse.level()};
    const std::vector<bend::NamedSocket> sockets{{"tip", fit::socket_at(fine.binding, 2, 0, 0)},
                                                 {"side", fit::socket_at(fine.binding, 0.5, 1, 0.1)}};
    const bend::BodyFile file = bend::load_copy(fit::bake({levels, {}, sockets})).value();
    REQUIRE(file.levels.size() == 2);
    const std::vector<bend::Pose> poses{{0.5f, 0.2f}, {-0.7f, 1.0f}};
    const std::vector<glm::vec3> was = deformed_as_stored(coarse.binding.body, poses),
                                 is = deformed_as_stored(file.levels[1].body, poses);
    CHECK(std::memcmp(was.data(), is.data(), was.size() * sizeof was[0]) == 0);

    const auto tip_of = [&](const bend::Body& body, const bend::Socket& socket) {
        bend::SocketFrame frame;
        bend::Sockets::make(body, {&socket, 1}).value().frames(poses, {&frame, 1});
        return frame[3];
    };
    CHECK(tip_of(file.levels[1].body, file.sockets[0].socket) ==
          tip_of(fine.binding.body, sockets[0].socket));
}

TEST_CASE("bake: errors name the level and what is wrong with it") {
    Random random(63);
    const Baked fine = bound_mesh(random_mesh(random, 12, 2), nullptr, some_options(random, 2));
    const Baked other = bound_mesh(random_mesh(random, 9, 2), nullptr, some_options(random, 2));
    const auto error_of = [](std::vector<fit::BakeLevel> levels) -> std::string {
        try {
            (void)fit::bake({levels});
        } catch (const fit::Error& error) {
            return error.what();
        }
        return {};
    };
    CHECK(error_of({fine.level()}).empty());
    CHECK(error_of({{}}) == "levels[0].binding: null; give what bind returned");
    CHECK(error_of({fine.level(), other.level()}) ==
          "levels[1].level: does not have the regions, tables and frame of the first level; bind it with "
          "bind_level");
    CHECK(error_of({}) ==
          "level: too few, too many, or not as many as other parts of it say; bake the file again");
    fit::BakeLevel level = fine.level();
    level.mesh.uvs = level.mesh.uvs.first(3);
    CHECK(error_of({level}) == "levels[0].uvs: give none, or one for each vertex");
    std::vector<std::uint32_t> triangles = fine.test_mesh.triangles;
    triangles[3] = 100000;
    level = fine.level();
    level.mesh.triangles = triangles;
    CHECK(error_of({level}).starts_with("levels[0].triangles[1]: vertex 100000 of "));
    fit::Binding binding = bound_mesh(random_mesh(random, 12, 2), nullptr, some_options(random, 2)).binding;
    const std::size_t count = binding.body.vertex_count();
    const auto ordered = [&](std::vector<std::uint32_t> order) {
        binding.order = std::move(order);
        level = {.binding = &binding};
        return error_of({level});
    };
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    CHECK(ordered(order) != ordered({1, 2, 3}));
    CHECK(ordered({1, 2, 3}).starts_with("levels[0].binding: its order has 3 vertices"));
    order[2] = 0xfffffff0;
    CHECK(ordered(order).starts_with("levels[0].binding: order[2]: vertex 4294967280 of "));
    order[2] = 1;
    CHECK(ordered(order).starts_with("levels[0].binding: order[2]: vertex 1 a second time"));
    CHECK_THROWS_AS((void)binding.vertices_in_body(), fit::Error);
}

}  // namespace goffer::test
