// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <doctest/doctest.h>

#include <limits>

/// Making a body: every fault is named; storage is aligned and padded as it says.

namespace goffer::test {
namespace {

struct Parts {
    std::vector<bend::RestVertex> vertices{{0.1, 0.2, 0.1, 0, 0}, {1, 1, 0.1, 0, 0}};
    std::vector<bend::RestVector> normals{{1, 0, 0}, {0, 0, 1}};
    std::vector<bend::RestVector> tangents{{0, 1, 0}, {0, 1, 0}};
    std::vector<float> signs{1, -1};
    std::vector<bend::RegionInput> regions{region()};

    [[nodiscard]] static bend::RegionInput region() {
        bend::RegionInput region;
        region.length = 1;
        region.max_angle = 2;
        region.vertex_count = 2;
        region.table.max_angle = 2;
        region.table.rows.resize(2);
        return region;
    }

    [[nodiscard]] bend::BodyInput input() const {
        bend::BodyInput input;
        input.radius = 0.1;
        input.regions = regions;
        input.vertices = vertices;
        input.normals = normals;
        input.tangents = tangents;
        input.tangent_signs = signs;
        return input;
    }
};

}  // namespace

TEST_CASE("a body is made of good input, and of nothing less") {
    using bend::Body;
    using bend::BodyFault;
    using bend::BodyInput;
    Parts parts;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    REQUIRE(Body::check(parts.input()) == BodyFault::none);
    REQUIRE(Body::make(parts.input()));
    const auto fault = [&](auto change) {
        Parts changed;
        BodyInput input = changed.input();
        change(input, changed);
        CHECK_FALSE(Body::make(input));
        return Body::check(input);
    };
    CHECK(fault([&](BodyInput& i, Parts&) { i.origin.x = nan; }) == BodyFault::origin);
    CHECK(fault([](BodyInput& i, Parts&) { i.axes[0] *= -1.0; }) == BodyFault::axes);
    CHECK(fault([](BodyInput& i, Parts&) { i.axes[2] = i.axes[1]; }) == BodyFault::axes);
    CHECK(fault([&](BodyInput& i, Parts&) { i.radius = nan; }) == BodyFault::radius);
    CHECK(fault([](BodyInput& i, Parts&) { i.regions = {}; }) == BodyFault::regions);
    CHECK(fault([](BodyInput& i, Parts& p) {
              p.regions.resize(bend::max_regions + 1, p.regions[0]);
              i.regions = p.regions;
          }) == BodyFault::regions);
    const auto region_fault = [&](auto change) {
        return fault([&](BodyInput&, Parts& p) { change(p.regions[0]); });
    };
    using bend::RegionInput;
    CHECK(region_fault([](RegionInput& r) { r.length = 0; }) == BodyFault::region_length);
    CHECK(region_fault([](RegionInput& r) { r.max_angle = 5.1; }) == BodyFault::region_max_angle);
    CHECK(region_fault([](RegionInput& r) { r.rest_angle = -0.1; }) == BodyFault::region_rest);
    CHECK(region_fault([](RegionInput& r) { r.rest_angle = 2.1; }) == BodyFault::region_rest);
    CHECK(region_fault([&](RegionInput& r) { r.rest_direction = nan; }) == BodyFault::region_rest);
    CHECK(region_fault([](RegionInput& r) { r.onset = -1; }) == BodyFault::region_onset);
    CHECK(region_fault([](RegionInput& r) { r.table.rows.resize(1); }) == BodyFault::region_table);
    CHECK(region_fault([&](RegionInput& r) { r.table.rows[1][3] = static_cast<float>(nan); }) ==
          BodyFault::region_table);
    CHECK(region_fault([](RegionInput& r) { r.factors.rows.resize(1); }) == BodyFault::region_factors);
    CHECK(region_fault([](RegionInput& r) { r.vertex_count = 1; }) == BodyFault::region_vertices);
    CHECK(region_fault([](RegionInput& r) { r.vertex_count = 3; }) == BodyFault::region_vertices);
    CHECK(fault([](BodyInput& i, Parts&) { i.vertices = {}; }) == BodyFault::vertices);
    CHECK(fault([](BodyInput&, Parts& p) { p.vertices[1].rho = -1; }) == BodyFault::vertices);
    CHECK(fault([](BodyInput&, Parts& p) { p.vertices[1].z = 1.1; }) == BodyFault::vertices);
    CHECK(fault([&](BodyInput&, Parts& p) { p.vertices[0].beta = nan; }) == BodyFault::vertices);
    CHECK(fault([](BodyInput& i, Parts& p) { i.normals = std::span(p.normals).first(1); }) ==
          BodyFault::normals);
    CHECK(fault([](BodyInput&, Parts& p) { p.normals[0] = {0, 0, 0}; }) == BodyFault::normals);
    CHECK(fault([&](BodyInput&, Parts& p) { p.normals[0] = {nan, 0, 0}; }) == BodyFault::normals);
    CHECK(fault([](BodyInput& i, Parts& p) { i.tangents = std::span(p.tangents).first(1); }) ==
          BodyFault::tangents);
    CHECK(fault([](BodyInput&, Parts& p) { p.tangents[1] = {2, 0, 0}; }) == BodyFault::tangents);
    CHECK(fault([](BodyInput& i, Parts&) { i.tangent_signs = {}; }) == BodyFault::tangent_signs);
    for (int i = 0; i <= static_cast<int>(BodyFault::tangent_signs); ++i) {
        CHECK(bend::describe(static_cast<BodyFault>(i)) != "unknown fault");
    }
}

TEST_CASE("columns are aligned, zero-filled and padded for a whole batch") {
    for (const std::size_t count : {1u, 15u, 16u, 17u, 1008u, 1024u, 4096u}) {
        Columns columns(3, count);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(reinterpret_cast<std::uintptr_t>(columns[c].data()) % column_alignment == 0);
            CHECK(columns[c].size() == count);
            for (std::size_t i = 0; i < count + widest_batch; ++i) REQUIRE(columns[c].data()[i] == 0.0f);
        }
        CHECK(columns.bytes() >= 3 * (count + widest_batch) * sizeof(float));
    }
}

TEST_CASE("a table's rows are met exactly and interpolated between") {
    bend::WrinkleTable table;
    CHECK(table.at(1.0)[0] == 0.0f);
    table.max_angle = 2;
    table.rows.resize(5);
    for (std::size_t i = 0; i < 5; ++i) table.rows[i].fill(static_cast<float>(i * i));
    CHECK(table.at(0)[0] == 0.0f);
    CHECK(table.at(2 * 0.5625)[6] == 9.0f);  // row 3 of 4: (3 / 4)^2 of the largest angle
    CHECK(table.at(2.0)[2] == 16.0f);
    CHECK(table.at(7.0)[2] == 16.0f);
    CHECK(table.at(-1.0)[2] == 0.0f);
    CHECK(table.at(2 * 0.875 * 0.875)[1] == doctest::Approx(12.5));
}

}  // namespace goffer::test
