// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

/// Levels of detail on one rig: vertices that levels share go to the same place, bit for bit.

namespace goffer::test {
namespace {

constexpr std::uint32_t fine_columns = 24, fine_rows = 65;

/// A coarser level: every other column and every fourth row of random_mesh's skin, and all of its loose
/// vertices, last to first.
struct Level {
    TestMesh test_mesh;
    std::vector<std::uint32_t> from;  // of each vertex: the one of the finer mesh

    void take(const TestMesh& fine, std::uint32_t vertex) {
        from.push_back(vertex);
        test_mesh.positions.push_back(fine.positions[vertex]);
        test_mesh.normals.push_back(fine.normals[vertex]);
        test_mesh.tangents.push_back(fine.tangents[vertex]);
    }
};

Level decimated(const TestMesh& fine) {
    Level level;
    level.test_mesh.cylinder = fine.cylinder;
    for (std::uint32_t row = 0; row < fine_rows; row += 4) {
        for (std::uint32_t column = 0; column < fine_columns; column += 2)
            level.take(fine, row * fine_columns + column);
    }
    for (auto i = static_cast<std::uint32_t>(fine.positions.size()); i-- > fine_rows * fine_columns;)
        level.take(fine, i);
    constexpr std::uint32_t around = fine_columns / 2;
    for (std::uint32_t row = 0; row + 4 < fine_rows; row += 4) {
        for (std::uint32_t column = 0; column < around; ++column) {
            const std::uint32_t a = row / 4 * around + column, b = row / 4 * around + (column + 1) % around;
            level.test_mesh.triangles.insert(level.test_mesh.triangles.end(),
                                             {a, b, a + around, b, b + around, a + around});
        }
    }
    return level;
}

/// Deformed positions, in the geometry's order.
std::vector<glm::vec3> deformed_in_order(const fit::Binding& binding, std::span<const bend::Pose> poses,
                                         Isa isa) {
    std::vector<glm::vec3> positions(binding.body.vertex_count()), sorted(positions.size());
    bend::DeformJob job;
    job.body = &binding.body;
    job.poses = poses;
    job.isa = isa;
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    REQUIRE(bend::validate(job).none());
    bend::run(job);
    for (std::size_t i = 0; i < positions.size(); ++i)
        sorted[binding.order.empty() ? i : binding.order[i]] = positions[i];
    return sorted;
}

bool same_bits(const glm::vec3& a, const glm::vec3& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

void check_levels(const TestMesh& fine, const fit::BindOptions& options) {
    const fit::Binding rig = fit::bind(fine.geometry(), fine.cylinder, options);
    const Level level = decimated(fine);
    const fit::Binding coarse = fit::bind_level(level.test_mesh.geometry(), rig);
    REQUIRE(coarse.body.vertex_count() == level.from.size());
    REQUIRE(coarse.body.region_count() == rig.body.region_count());
    for (const Isa isa : isas_here()) {
        for (const float share : {0.0f, 1e-3f, -0.3f, 0.8f, 1.0f, 2.0f}) {
            std::vector<bend::Pose> poses;
            for (std::size_t r = 0; r < rig.body.region_count(); ++r) {
                const float sign = r % 2 == 0 ? 1.0f : -1.0f;
                poses.push_back({sign * share * rig.body.max_angle(r), 0.7f + static_cast<float>(r)});
            }
            const std::vector<glm::vec3> all = deformed_in_order(rig, poses, isa),
                                         some = deformed_in_order(coarse, poses, isa);
            std::size_t equal = 0;
            for (std::size_t i = 0; i < some.size(); ++i)
                equal += same_bits(some[i], all[level.from[i]]) ? 1 : 0;
            CAPTURE(share);
            CHECK(equal == some.size());
        }
    }
}

}  // namespace

TEST_CASE("levels: shared vertices go to the same place, bit for bit") {
    Random random(71);
    const TestMesh fine = random_mesh(random, 9, 3, fine_columns, fine_rows);
    fit::BindOptions options;
    options.folds = 3;
    check_levels(fine, options);
    options.amplitude = paper::Amplitude::none;
    check_levels(fine, options);
    options.amplitude = paper::Amplitude::paper;
    options.onset = 0.01;
    check_levels(fine, options);
}

TEST_CASE("levels: of several regions, and with factors for the rig's own area") {
    Random random(72);
    const TestMesh fine = random_mesh(random, 12, 0.2, fine_columns, fine_rows);
    fit::BindOptions options;
    options.folds = 1;
    options.regions = {{0.5, {}}, {0.2, 0}, {0.3, {}}};
    check_levels(fine, options);
    options.amplitude = paper::Amplitude::mesh;
    check_levels(fine, options);
    options.regions = {};
    check_levels(fine, options);
}

TEST_CASE("levels: of a body that is bent at rest") {
    Random random(73);
    TestMesh fine = random_mesh(random, 14, 2, fine_columns, fine_rows, 0);
    fine.cylinder.rest_angle = 1.1;
    fine.cylinder.rest_direction = 0.4;
    const glm::dmat3 axes(fine.cylinder.zero, glm::cross(fine.cylinder.axis, fine.cylinder.zero),
                          fine.cylinder.axis);
    const paper::Parameters body{.length = fine.cylinder.length, .radius = fine.cylinder.radius};
    const paper::ClosedForm bend(body, {fine.cylinder.rest_angle, fine.cylinder.rest_direction});
    for (glm::vec3& p : fine.positions) {
        const glm::dvec3 local = glm::transpose(axes) * (glm::dvec3(p) - fine.cylinder.origin);
        p = fine.cylinder.origin + axes * bend.position(paper::to_cylindrical(local));
    }
    fit::BindOptions options;
    options.regions = {{0.4, {}}, {0.6, {}}};
    check_levels(fine, options);
}

TEST_CASE("levels: what is shared is the rig's, and what is found is the level's") {
    Random random(74);
    const TestMesh fine = random_mesh(random, 10, 1, fine_columns, fine_rows);
    fit::BindOptions options;
    options.folds = 2;
    options.profile = paper::Profile::smooth;
    options.regions = {{0.5, {}}, {0.5, {}}};
    const fit::Binding rig = fit::bind(fine.geometry(), fine.cylinder, options);
    Level level = decimated(fine);
    level.test_mesh.normals.clear();
    level.test_mesh.tangents.clear();
    const fit::Binding coarse = fit::bind_level(level.test_mesh.geometry(), rig);
    CHECK(coarse.profile == paper::Profile::smooth);
    CHECK(coarse.cylinder.length == rig.cylinder.length);
    CHECK_FALSE(coarse.body.has_tangents());
    const std::span<const bend::RegionInput> shared = coarse.body.region_inputs(),
                                             own = rig.body.region_inputs();
    for (std::size_t r = 0; r < 2; ++r) {
        CHECK(coarse.folds(r) == 2);
        CHECK(coarse.folds_capacity(r) < rig.folds_capacity(r));
        CHECK(shared[r].max_angle == own[r].max_angle);
        CHECK(shared[r].table.rows == own[r].table.rows);
        CHECK(shared[r].vertex_count < own[r].vertex_count);
    }
    const fit::Binding again = fit::bind_level(fine.geometry(), coarse);
    CHECK(again.order == rig.order);
    CHECK(again.folds_capacity(1) == rig.folds_capacity(1));
}

TEST_CASE("levels: what cannot be bound to a rig is named") {
    Random random(75);
    const TestMesh fine = random_mesh(random, 10, 1, fine_columns, fine_rows, 0);
    fit::Binding rig = fit::bind(fine.geometry(), fine.cylinder);
    Level beyond = decimated(fine);
    beyond.test_mesh.positions[0] -= glm::vec3(0.01 * fine.cylinder.axis);
    CHECK_THROWS_WITH_AS((void)fit::bind_level(beyond.test_mesh.geometry(), rig),
                         doctest::Contains("outside"), fit::Error);
    beyond.test_mesh.triangles.clear();
    CHECK_THROWS_WITH_AS((void)fit::bind_level(beyond.test_mesh.geometry(), rig),
                         doctest::Contains("triangles"), fit::Error);
    const bend::Body taken = std::move(rig.body);
    CHECK_THROWS_WITH_AS((void)fit::bind_level(fine.geometry(), rig), doctest::Contains("rig"), fit::Error);
}

}  // namespace goffer::test
