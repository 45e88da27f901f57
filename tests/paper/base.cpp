// SPDX-License-Identifier: MIT
#include <goffer/paper/base.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

using namespace goffer::paper;

namespace {

double volume(const BaseMesh& mesh) {
    double six = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return mesh.positions[mesh.triangles[i + corner]]; };
        six += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    return six / 6;
}

}  // namespace

TEST_CASE("the base mesh: rings of vertices in order of beta, from base to tip") {
    const BaseMesh mesh = base_mesh(4, 0.5, 8, 3);
    REQUIRE(mesh.positions.size() == 24);
    CHECK(mesh.triangles.size() == 3 * 2 * 8 * 2);
    CHECK(glm::length(mesh.positions[0] - glm::dvec3(0.5, 0, 0)) < 1e-15);
    CHECK(glm::length(mesh.positions[2] - glm::dvec3(0, 0.5, 0)) < 1e-15);
    CHECK(mesh.positions[8].z == 2);
    CHECK(mesh.positions[23].z == 4);
}

TEST_CASE("with caps the base mesh is closed and its triangles face outward") {
    const std::uint32_t columns = 12;
    const BaseMesh mesh = base_mesh(4, 0.5, columns, 5, true);
    REQUIRE(mesh.positions.size() == 5 * columns + 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.triangles[i + k], mesh.triangles[i + (k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.contains({edge.second, edge.first}));
    }
    const double polygon = columns / 2.0 * std::sin(2 * std::numbers::pi / columns) * 0.25;
    CHECK(volume(mesh) == doctest::Approx(4 * polygon).epsilon(1e-14));
}

TEST_CASE("a base mesh of no size is refused, the smallest one is not") {
    CHECK(base_mesh(1, 1, 3, 2).positions.size() == 6);
    CHECK_THROWS_AS(static_cast<void>(base_mesh(0, 1, 8, 3)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(base_mesh(1, std::nan(""), 8, 3)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(base_mesh(1, 1, 2, 3)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(base_mesh(1, 1, 8, 1)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(base_mesh(1, 1, 70000, 70000)), std::invalid_argument);
}
