// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/mesh/refined.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

/// How polygons are cut into triangles: without overlap where they are concave, into fans where they are
/// convex or broken.

using namespace goffer;
using namespace goffer::test;

namespace {

using Points = std::vector<glm::dvec2>;
using Triangles = std::vector<std::uint32_t>;

/// Twice the signed area.
double twice_area(const Points& points, std::span<const std::uint32_t> corners) {
    double sum = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec2 a = points[corners[k]], b = points[corners[(k + 1) % corners.size()]];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

double area_of(const Points& points) {
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0u);
    return twice_area(points, all) / 2;
}

glm::dmat3 turned(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    };
    const glm::dvec3 a = direction(), b = glm::normalize(glm::cross(a, direction()));
    return {a, b, glm::cross(a, b)};
}

/// One face with these corners, in the plane that `axes` has x and y of.
mesh::Mesh face(const Points& points, const glm::dmat3& axes = glm::dmat3(1), const glm::dvec3& at = {}) {
    mesh::Mesh mesh;
    for (const glm::dvec2& p : points) mesh.positions.emplace_back(at + axes * glm::dvec3(p, 0));
    mesh.corners.resize(points.size());
    std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
    mesh.faces = {static_cast<std::uint32_t>(points.size())};
    return mesh;
}

Triangles fan(std::size_t corners) {
    Triangles triangles;
    for (std::uint32_t k = 1; k + 1 < corners; ++k) triangles.insert(triangles.end(), {0, k, k + 1});
    return triangles;
}

/// Triangles that are wound as the face is, and together have its area, cover it once.
void check_covers(const Points& points, const Triangles& triangles) {
    CHECK(triangles.size() == 3 * (points.size() - 2));
    const double whole = 2 * area_of(points);
    double sum = 0;
    int turned_over = 0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const double own = twice_area(points, std::span(triangles).subspan(t, 3));
        if (own * whole < -1e-6 * whole * whole) ++turned_over;
        sum += std::fabs(own);
    }
    CHECK(turned_over == 0);
    CHECK(std::fabs(sum / std::fabs(whole) - 1) < 1e-5);
}

/// A star with so many points, from radius 1 to `inner`.
Points star(int points, double inner) {
    Points result;
    for (int k = 0; k < 2 * points; ++k) {
        const double angle = std::numbers::pi * k / points, radius = k % 2 == 0 ? 1 : inner;
        result.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return result;
}

/// A prism of length 4 on a star: two caps of one polygon each, and quads.
mesh::Mesh star_prism(int points, double inner) {
    const Points outline = star(points, inner);
    const auto size = static_cast<std::uint32_t>(outline.size());
    mesh::Mesh mesh;
    for (const float z : {0.0f, 4.0f})
        for (const glm::dvec2& p : outline) mesh.positions.emplace_back(p.x, p.y, z);
    for (std::uint32_t k = 0; k < size; ++k) mesh.corners.push_back(size - 1 - k);
    for (std::uint32_t k = 0; k < size; ++k) mesh.corners.push_back(size + k);
    mesh.faces = {size, size};
    for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t next = (k + 1) % size;
        mesh.corners.insert(mesh.corners.end(), {k, next, size + next, size + k});
        mesh.faces.push_back(4);
    }
    return mesh;
}

double surface(const mesh::Mesh& mesh) {
    return fit::surface_area(mesh.positions, mesh::triangles(mesh));
}

}  // namespace

TEST_CASE("polygons: a star prism has the area of a star prism, in every format") {
    const Points outline = star(5, 0.4);
    double around = 0;
    for (std::size_t k = 0; k < outline.size(); ++k)
        around += glm::distance(outline[k], outline[(k + 1) % outline.size()]);
    const double truth = 2 * area_of(outline) + 4 * around;
    const mesh::Mesh prism = star_prism(5, 0.4);
    CHECK(std::fabs(surface(prism) / truth - 1) < 1e-6);
    for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
        CAPTURE(name);
        CHECK(std::fabs(surface(reloaded(prism, name)) / truth - 1) < 1e-6);
    }
    const mesh::VertexArrays arrays = mesh::vertex_arrays(prism);
    CHECK(std::fabs(fit::surface_area(arrays.positions, arrays.triangles) / truth - 1) < 1e-6);
}

TEST_CASE("polygons: concave ones are covered once, from whichever corner they begin") {
    std::vector<Points> outlines{
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},                  // an L
        {{0, 0}, {1, 0.2}, {2, 0}, {1, 2}},                                // an arrowhead
        {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},  // a U
        {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}},  // corners on its edges
        {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 1}, {2, 4}, {0, 4}},          // a slit
        {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}},  // around a hole
    };
    outlines.push_back(star(3, 0.2));
    outlines.push_back(star(40, 0.7));
    std::mt19937 random(7);
    for (Points points : outlines) {
        for (std::size_t start = 0; start < points.size(); ++start) {
            CAPTURE(points.size());
            CAPTURE(start);
            std::rotate(points.begin(), points.begin() + 1, points.end());
            check_covers(points, mesh::triangles(face(points)));
            check_covers(points, mesh::triangles(face(points, turned(random), {3, -2, 9})));
            Points backward(points.rbegin(), points.rend());
            check_covers(backward, mesh::triangles(face(backward, turned(random))));
        }
    }
}

TEST_CASE("polygons: random outlines are covered once") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.05, 1);
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        const int size = 4 + round % 37;
        Points points;
        for (int k = 0; k < size; ++k) {
            const double angle = 2 * std::numbers::pi * k / size, radius = uniform(random);
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
        check_covers(points, mesh::triangles(face(points, turned(random))));
    }
}

TEST_CASE("polygons: random holes, which the outline goes around and comes back from the way it came") {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> uniform(0.2, 1);
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        const int size = 3 + round % 11;
        Points points;
        // The bridge is from the first corner outside to the first one inside, and both occur twice.
        for (int k = 0; k <= size; ++k) {
            const double angle = 2 * std::numbers::pi * (k % size) / size;
            points.emplace_back(4 * std::cos(angle), 4 * std::sin(angle));
        }
        std::vector<double> radii(static_cast<std::size_t>(size));
        for (double& radius : radii) radius = uniform(random);
        for (int k = size; k >= 0; --k) {
            const double angle = 2 * std::numbers::pi * (k % size) / size;
            const double radius = radii[static_cast<std::size_t>(k % size)];
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
        std::rotate(points.begin(), points.begin() + round % static_cast<int>(points.size()), points.end());
        check_covers(points, mesh::triangles(face(points)));
        check_covers(points, mesh::triangles(face(points, turned(random))));
    }
}

TEST_CASE("polygons: convex ones are fans around the first corner, however they lie") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        std::vector<double> angles(static_cast<std::size_t>(4 + round % 60));
        for (double& angle : angles) angle = 2 * std::numbers::pi * uniform(random);
        std::ranges::sort(angles);
        Points points;
        for (const double angle : angles) points.emplace_back(std::cos(angle), 0.3 * std::sin(angle));
        for (int more = 0; more < 3; ++more) {  // corners on an edge, which rounding moves to either side
            const std::size_t edge = static_cast<std::size_t>(uniform(random) * 3);
            points.insert(points.begin() + static_cast<std::ptrdiff_t>(edge) + 1,
                          glm::mix(points[edge], points[edge + 1], uniform(random)));
        }
        const glm::dvec3 at = round % 2 == 0 ? glm::dvec3(0) : glm::dvec3(1000, -200, 30);
        CHECK(mesh::triangles(face(points, turned(random), at)) == fan(points.size()));
    }
}

TEST_CASE("polygons: what crosses itself, has no area or too many corners is a fan") {
    Points pentagram;
    for (int k = 0; k < 5; ++k)
        pentagram.emplace_back(std::cos(0.8 * std::numbers::pi * k), std::sin(0.8 * std::numbers::pi * k));
    const Points bow_tie{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    const Points needle{{0, 0}, {1, 0}, {2, 0}, {1, 0}, {0.5, 0}};
    for (const Points& points : {pentagram, bow_tie, needle, Points(6)})
        CHECK(mesh::triangles(face(points)) == fan(points.size()));
    const Points most = star(2048, 0.9), more = star(2049, 0.9);
    check_covers(most, mesh::triangles(face(most)));
    CHECK(mesh::triangles(face(more)) == fan(more.size()));
}

TEST_CASE("polygons: corners that occur twice, and any other disorder, give as many triangles as promised") {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> grid(0, 3);
    for (int round = 0; round < 2000; ++round) {
        Points points(static_cast<std::size_t>(4 + round % 9));
        for (glm::dvec2& p : points) p = {grid(random), grid(random)};
        const Triangles triangles = mesh::triangles(face(points, turned(random)));
        REQUIRE(triangles.size() == 3 * (points.size() - 2));
        CHECK(std::ranges::max(triangles) < points.size());
        double cut = 0, fanned = 0;
        const Triangles plain = fan(points.size());
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            cut += std::fabs(twice_area(points, std::span(triangles).subspan(t, 3)));
            fanned += std::fabs(twice_area(points, std::span(plain).subspan(t, 3)));
        }
        CHECK(cut < fanned + 1e-4);  // never worse than a fan
    }
}

TEST_CASE("polygons: pieces of a concave face lie in the triangles that it is cut into") {
    const mesh::Mesh prism = star_prism(5, 0.4);
    const Triangles triangles = mesh::triangles(prism);
    std::vector<std::uint32_t> pieces, parents;
    const std::vector<mesh::EdgeVertex> none;
    for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) {
        for (std::size_t k = 0; k < 3; ++k) pieces.push_back(triangles[3 * t + k]);
        parents.push_back(t);
    }
    CHECK(mesh::refined(prism, {none, pieces, parents}).faces == prism.faces);
    const std::vector<mesh::EdgeVertex> one{{triangles[0], triangles[1], 0.5}};
    const auto next = static_cast<std::uint32_t>(prism.positions.size());
    // The first triangle of the first cap is halved, and so the cap becomes triangles.
    std::vector<std::uint32_t> cut{triangles[0], next, triangles[2], next, triangles[1], triangles[2]};
    cut.insert(cut.end(), pieces.begin() + 3, pieces.end());
    parents.insert(parents.begin(), 0);
    const mesh::Mesh refined = mesh::refined(prism, {one, cut, parents});
    CHECK(refined.faces.size() == prism.faces.size() - 1 + 9);
    CHECK(std::fabs(surface(refined) / surface(prism) - 1) < 1e-6);
}
