// SPDX-License-Identifier: MIT
#include "refusals.hpp"
#include "synthetic.hpp"

#include <goffer/fit/patches.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace goffer;
using namespace goffer::test;

TEST_CASE("patches: triangles are where their centroids are, and sides lie about e1, e2, -e1, -e2") {
    const Solid solid = tube(64);
    const std::vector<std::uint32_t> patches = fit::patches_of(solid.geometry(), upright());
    REQUIRE(3 * patches.size() == solid.triangles.size());
    CHECK(std::set(patches.begin(), patches.end()).size() == 48);
    for (std::size_t t = 0; t < patches.size(); ++t) {
        glm::dvec3 centroid(0);
        for (std::size_t i = 0; i < 3; ++i)
            centroid += glm::dvec3(solid.positions[solid.triangles[3 * t + i]]) / 3.0;
        const bool along_x = std::abs(centroid.x) > std::abs(centroid.y);
        const int side = along_x ? (centroid.x > 0 ? 0 : 2) : (centroid.y > 0 ? 1 : 3);
        CHECK(patches[t] == static_cast<std::uint32_t>(4 * static_cast<int>(centroid.z / 10 * 12) + side));
    }
}

TEST_CASE("patches: a body that is bent at rest is straightened first") {
    const Solid solid = tube(64);
    fit::Cylinder bent = upright();
    bent.rest_angle = 1;
    // About an arc toward x: its center line's radius is L / alpha_0 - r.
    Solid curved = solid;
    const double radius = 10.0 / 1.0 - 1;
    for (glm::vec3& p : curved.positions) {
        const double phi = double{p.z} / 10, from = radius - double{p.x};
        p = {static_cast<float>(radius - from * std::cos(phi)), p.y,
             static_cast<float>(from * std::sin(phi))};
    }
    const auto straight = fit::patches_of(solid.geometry(), upright());
    const auto arc = fit::patches_of(curved.geometry(), bent);
    std::size_t other = 0;
    for (std::size_t t = 0; t < arc.size(); ++t) other += arc[t] != straight[t] ? 1 : 0;
    CHECK(other == 0);
}

TEST_CASE("patches: any grid, what lies beyond an end is in the slice there") {
    const Solid solid = tube(64);
    fit::Cylinder shorter = upright();
    shorter.origin.z = 2;
    shorter.length = 6;
    const auto one = fit::patches_of(solid.geometry(), upright(), {1, 1});
    CHECK(std::set(one.begin(), one.end()) == std::set<std::uint32_t>{0});
    const auto three = fit::patches_of(solid.geometry(), shorter, {3, 1});
    CHECK(three.front() == 0);
    CHECK(three.back() == 2);
    for (const fit::PatchGrid grid :
         {fit::PatchGrid{0, 4}, fit::PatchGrid{12, 0}, fit::PatchGrid{1 << 17, 1}})
        CHECK(error_of([&] {
                  return fit::patches_of(solid.geometry(), upright(), grid);
              }).starts_with("patches: "));
}

TEST_CASE("patches: changes are weighted by area, the worst has its place, no area does not count") {
    // Three triangles of area 1, 3 and 0; the first doubles, the second loses a third, the third appears.
    const std::vector<glm::vec3> rest{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {3, 0, 0}, {0, 0, 1}, {5, 5, 5}};
    std::vector<glm::vec3> bent = rest;
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 3, 2, 5, 5, 4};
    const fit::Geometry geometry{rest, triangles};
    bent[1] = {2, 0, 0};
    bent[3] = {2, 0, 0};
    const fit::PatchChange apart = fit::patch_change(geometry, bent, std::vector<std::uint32_t>{7, 3, 5});
    CHECK(apart.patches == 2);
    CHECK(apart.worst == doctest::Approx(1));
    CHECK(apart.worst_patch == 7);
    CHECK(apart.rms == doctest::Approx(std::sqrt((1 * 1.0 + 3 / 9.0) / 4)));
    const fit::PatchChange whole = fit::patch_change(geometry, bent, std::vector<std::uint32_t>{0, 0, 0});
    CHECK(whole.rms == doctest::Approx(0));
    const std::vector<double> vertices = fit::vertex_change(geometry, bent);
    CHECK(vertices[0] == doctest::Approx(0));         // 1 + 3 before, 2 + 2 after
    CHECK(vertices[1] == doctest::Approx(1));         // of the first alone
    CHECK(vertices[3] == doctest::Approx(-1.0 / 3));  // of the second alone
    CHECK(vertices[4] == 0);                          // none before
}

TEST_CASE("patches: what does not fit is refused") {
    const Solid solid = tube(64);
    const std::span positions(solid.positions);
    const std::vector<std::uint32_t> patches(solid.triangles.size() / 3);
    CHECK(error_of([&] {
              return fit::patch_change(solid.geometry(), positions.first(3), patches);
          }).starts_with("positions: 3 for "));
    CHECK(error_of([&] {
              return fit::vertex_change(solid.geometry(), positions.first(3));
          }).starts_with("positions: 3 for "));
    CHECK(error_of([&] {
              return fit::patches_of(solid.geometry(), {}, {.slices = 65536, .sides = 17});
          }).ends_with("are more than 1048576 patches; give fewer"));
    CHECK(error_of([&] {
              return fit::patch_change(solid.geometry(), positions, std::span(patches).first(2));
          }).starts_with("patches: 2 for "));
}
