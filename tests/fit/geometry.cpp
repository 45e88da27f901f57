// SPDX-License-Identifier: MIT
#include "support/says.hpp"
#include "synthetic.hpp"

#include <goffer/fit/geometry.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace goffer;
using test::says;
using test::Solid;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

const Solid tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}};

/// The fault's message, or nothing.
std::string geometry_fault(const fit::Geometry& geometry) {
    try {
        fit::check(geometry);
    } catch (const fit::Error& error) {
        return error.what();
    }
    return {};
}

/// The tetrahedron's vertices drawn onto a plane, line or point, turned and moved.
Solid flattened(const glm::dvec3& keep, double move) {
    std::mt19937 random(5);
    test::Placing placing = test::random_placing(move, random);
    Solid solid = tetrahedron;
    for (glm::vec3& p : solid.positions) p *= keep;
    return test::placed(solid, placing);
}

}  // namespace

TEST_CASE("a solid passes, whatever its scale") {
    for (const float scale : {1e-30f, 1e-4f, 1.0f, 1e4f, 1e30f}) {
        Solid solid = tetrahedron;
        for (glm::vec3& p : solid.positions) p *= scale;
        CHECK(geometry_fault(solid.geometry()) == "");
    }
}

TEST_CASE("faults of triangles are named with index and mend") {
    Solid solid = tetrahedron;
    CHECK(says(geometry_fault({solid.positions, {}}), "no triangles"));
    CHECK(says(geometry_fault({{}, {}}), "no triangles"));
    CHECK(says(geometry_fault({{}, solid.triangles}), "triangle 0 uses vertex 0, but the mesh has 0"));
    solid.triangles[7] = 4;
    CHECK(says(geometry_fault(solid.geometry()), "triangle 2 uses vertex 4, but the mesh has 4"));
    solid.triangles[7] = 0xffffffffu;
    CHECK(says(geometry_fault(solid.geometry()), "triangle 2 uses vertex 4294967295"));
    solid.triangles.pop_back();
    CHECK(says(geometry_fault(solid.geometry()), "11 indices are not a multiple of 3"));
}

TEST_CASE("numbers that are not finite are named with their vertex, used or not") {
    for (const float bad : {not_a_number, infinite, -infinite}) {
        for (std::size_t vertex = 0; vertex < 5; ++vertex) {
            Solid solid = tetrahedron;
            solid.positions.emplace_back(2, 2, 2);
            solid.positions[vertex].y = bad;
            const std::string named = "position of vertex " + std::to_string(vertex) + " is NaN or infinite";
            CHECK(says(geometry_fault(solid.geometry()), named.c_str()));
        }
    }
    std::vector<glm::vec3> normals(4, glm::vec3(0, 0, 1));
    std::vector<glm::vec4> tangents(4, glm::vec4(1, 0, 0, 1));
    CHECK(geometry_fault({tetrahedron.positions, tetrahedron.triangles, normals, tangents}) == "");
    tangents[2].w = infinite;
    CHECK(says(geometry_fault({tetrahedron.positions, tetrahedron.triangles, normals, tangents}),
               "tangent of vertex 2"));
    normals[3].x = not_a_number;
    CHECK(says(geometry_fault({tetrahedron.positions, tetrahedron.triangles, normals, tangents}),
               "normal of vertex 3"));
}

TEST_CASE("optional streams hold one value per vertex or none") {
    const std::vector<glm::vec3> normals(3, glm::vec3(0, 0, 1));
    const std::vector<glm::vec4> tangents(5, glm::vec4(1, 0, 0, 1));
    CHECK(says(geometry_fault({tetrahedron.positions, tetrahedron.triangles, normals, {}}),
               "normals: 3 for 4 vertices"));
    CHECK(says(geometry_fault({tetrahedron.positions, tetrahedron.triangles, {}, tangents}),
               "tangents: 5 for 4 vertices"));
}

TEST_CASE("a point, a line, a plane are told apart and refused, turned and moved") {
    for (const double move : {0.0, 1.0, 100.0}) {
        CHECK(says(geometry_fault(flattened({0, 0, 0}, move).geometry()), "in one point"));
        CHECK(says(geometry_fault(flattened({0, 0, 1}, move).geometry()), "on one line"));
        CHECK(says(geometry_fault(flattened({1, 0, 1}, move).geometry()), "in one plane"));
        CHECK(geometry_fault(flattened({1, 1, 1}, move).geometry()) == "");
    }
}

TEST_CASE("one triangle, and vertices that no triangle uses, make no solid") {
    const std::vector<std::uint32_t> one{0, 1, 3};
    CHECK(says(geometry_fault({tetrahedron.positions, one}), "in one plane"));
}

TEST_CASE("surface area of a tetrahedron and of a prism") {
    CHECK(fit::surface_area(tetrahedron.positions, tetrahedron.triangles) ==
          doctest::Approx(0.5 + 1.5 + 1.5 + 0.5 * std::sqrt(19.0)).epsilon(1e-12));
    std::mt19937 random(1);
    const Solid prism = test::cylinder({.columns = 12, .rows = 7, .length = 5}, random);
    const double half = std::numbers::pi / 12;
    CHECK(fit::surface_area(prism.positions, prism.triangles) ==
          doctest::Approx(12 * 5 * 2 * std::sin(half) + 12 * std::sin(2 * half)).epsilon(1e-6));
    CHECK(fit::surface_area({}, {}) == 0);
}
