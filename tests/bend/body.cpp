// SPDX-License-Identifier: MIT
#include "not_finite.hpp"
#include "support/bodies.hpp"

#include <goffer/bend/body_input.hpp>

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

/// Making a body: every fault is named, with its place; storage is aligned and padded as it says; tables
/// survive any bits.

namespace goffer::test {
namespace {

using bend::Body;
using bend::BodyFault;
using bend::BodyField;
using bend::BodyInput;
using bend::Reason;
using bend::RegionInput;
using bend::RestVertex;

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

/// What Body::check finds after `change(input, parts)`; make must refuse the same.
template <class Change>
BodyFault fault_of(const Change& change) {
    Parts parts;
    BodyInput input = parts.input();
    change(input, parts);
    const BodyFault fault = Body::check(input);
    CHECK(Body::make(input).has_value() == fault.none());
    return fault;
}

template <class Change>
BodyFault region_fault(const Change& change) {
    return fault_of([&](BodyInput&, Parts& parts) { change(parts.regions[0]); });
}

template <class Change>
BodyFault vertex_fault(const Change& change) {
    return fault_of([&](BodyInput&, Parts& parts) { change(parts.vertices[1]); });
}

std::string text_of(const BodyFault& fault) {
    return bend::describe(fault).c_str();
}

constexpr std::size_t nowhere = BodyFault::nowhere;

}  // namespace

TEST_CASE("a body is made of good input, and of nothing less") {
    CHECK(fault_of([](BodyInput&, Parts&) {}).none());
    CHECK(fault_of([](BodyInput& i, Parts&) { i.origin.x = nan; }) ==
          BodyFault{BodyField::origin, Reason::not_finite, nowhere});
    CHECK(fault_of([](BodyInput& i, Parts&) { i.axes[0] *= -1.0; }) ==
          BodyFault{BodyField::axes, Reason::out_of_range, nowhere});
    CHECK(fault_of([](BodyInput& i, Parts&) { i.axes[2] = i.axes[1]; }).field == BodyField::axes);
    CHECK(fault_of([](BodyInput& i, Parts&) { i.axes[1][1] = nan; }).reason == Reason::not_finite);
    CHECK(fault_of([](BodyInput& i, Parts&) { i.radius = nan; }).field == BodyField::radius);
    CHECK(fault_of([](BodyInput& i, Parts&) { i.regions = {}; }) ==
          BodyFault{BodyField::regions, Reason::empty, nowhere});
    CHECK(fault_of([](BodyInput& i, Parts& p) {
              p.regions.resize(bend::max_regions + 1, p.regions[0]);
              i.regions = p.regions;
          }) == BodyFault{BodyField::regions, Reason::count, nowhere});
    CHECK(fault_of([](BodyInput& i, Parts&) { i.vertices = {}; }) ==
          BodyFault{BodyField::vertices, Reason::empty, nowhere});
}

TEST_CASE("a region's faults are named, with its index") {
    CHECK(region_fault([](RegionInput& r) { r.length = 0; }) ==
          BodyFault{BodyField::length, Reason::out_of_range, 0});
    CHECK(region_fault([](RegionInput& r) { r.max_angle = 5.1; }).field == BodyField::max_angle);
    CHECK(region_fault([](RegionInput& r) { r.max_angle = 0; }).field == BodyField::max_angle);
    CHECK(region_fault([](RegionInput& r) { r.rest_angle = -0.1; }).field == BodyField::rest_angle);
    CHECK(region_fault([](RegionInput& r) { r.rest_angle = 2.1; }).field == BodyField::rest_angle);
    CHECK(region_fault([](RegionInput& r) { r.rest_direction = nan; }) ==
          BodyFault{BodyField::rest_direction, Reason::not_finite, 0});
    CHECK(region_fault([](RegionInput& r) { r.onset = -1; }).field == BodyField::onset);
    CHECK(region_fault([](RegionInput& r) { r.table.rows.resize(1); }) ==
          BodyFault{BodyField::table, Reason::count, 0});
    CHECK(region_fault([](RegionInput& r) { r.table.rows[1][3] = nan; }) ==
          BodyFault{BodyField::table, Reason::not_finite, 0});
    CHECK(region_fault([](RegionInput& r) { r.table.max_angle = 0; }).field == BodyField::table);
    CHECK(region_fault([](RegionInput& r) { r.factors.rows.resize(1); }) ==
          BodyFault{BodyField::factors, Reason::count, 0});
    CHECK(region_fault([](RegionInput& r) { r.vertex_count = 1; }) ==
          BodyFault{BodyField::vertex_count, Reason::count, nowhere});
    CHECK(region_fault([](RegionInput& r) { r.vertex_count = 3; }).field == BodyField::vertex_count);
    CHECK(region_fault([](RegionInput& r) { r.vertex_count = ~std::size_t{0}; }).field ==
          BodyField::vertex_count);
    CHECK(fault_of([](BodyInput& i, Parts& p) {
              p.regions.resize(3, p.regions[0]);
              p.regions[2].max_angle = infinity;
              i.regions = p.regions;
          }) == BodyFault{BodyField::max_angle, Reason::not_finite, 2});
}

TEST_CASE("a vertex's faults are named, with its index") {
    CHECK(vertex_fault([](RestVertex& v) { v.rho = -1; }) ==
          BodyFault{BodyField::rho, Reason::out_of_range, 1});
    CHECK(vertex_fault([](RestVertex& v) { v.z = 1.1; }) == BodyFault{BodyField::z, Reason::out_of_range, 1});
    CHECK(vertex_fault([](RestVertex& v) { v.z = -0.1; }).field == BodyField::z);
    CHECK(vertex_fault([](RestVertex& v) { v.beta = nan; }) ==
          BodyFault{BodyField::beta, Reason::not_finite, 1});
    CHECK(vertex_fault([](RestVertex& v) { v.wrinkle = infinity; }) ==
          BodyFault{BodyField::wrinkle, Reason::not_finite, 1});
    CHECK(vertex_fault([](RestVertex& v) { v.slope = nan; }) ==
          BodyFault{BodyField::slope, Reason::not_finite, 1});
    CHECK(fault_of([](BodyInput& i, Parts& p) { i.normals = std::span(p.normals).first(1); }) ==
          BodyFault{BodyField::normals, Reason::count, nowhere});
    CHECK(fault_of([](BodyInput&, Parts& p) {
              p.normals[0] = {0, 0, 0};
          }) == BodyFault{BodyField::normals, Reason::out_of_range, 0});
    CHECK(fault_of([](BodyInput&, Parts& p) {
              p.normals[1] = {nan, 0, 0};
          }) == BodyFault{BodyField::normals, Reason::not_finite, 1});
    CHECK(fault_of([](BodyInput& i, Parts& p) { i.tangents = std::span(p.tangents).first(1); }) ==
          BodyFault{BodyField::tangents, Reason::count, nowhere});
    CHECK(fault_of([](BodyInput&, Parts& p) {
              p.tangents[1] = {2, 0, 0};
          }) == BodyFault{BodyField::tangents, Reason::out_of_range, 1});
    CHECK(fault_of([](BodyInput& i, Parts&) { i.tangent_signs = {}; }) ==
          BodyFault{BodyField::tangent_signs, Reason::count, nowhere});
    CHECK(fault_of([](BodyInput&, Parts& p) { p.signs[1] = nan; }) ==
          BodyFault{BodyField::tangent_signs, Reason::not_finite, 1});
}

TEST_CASE("what would leave float's range is refused") {
    for (const double bad : {1e300, 1.1e12, 0.9e-12, 1e-300}) {
        CAPTURE(bad);
        CHECK(fault_of([&](BodyInput& i, Parts&) { i.radius = bad; }) ==
              BodyFault{BodyField::radius, Reason::out_of_range, nowhere});
        CHECK(region_fault([&](RegionInput& r) { r.length = bad; }) ==
              BodyFault{BodyField::length, Reason::out_of_range, 0});
    }
    CHECK(fault_of([](BodyInput& i, Parts&) { i.origin.z = -2e15; }).field == BodyField::origin);
    CHECK(fault_of([](BodyInput& i, Parts&) { i.origin.z = -1e15; }).none());
    CHECK(fault_of([](BodyInput& i, Parts&) { i.radius = 1e-9; }).none());
    CHECK(fault_of([](BodyInput& i, Parts& p) {
              i.radius = 1e-9;
              p.regions[0].max_angle = 1001;
          }).field == BodyField::max_angle);
    CHECK(region_fault([](RegionInput& r) { r.max_angle = 1e-50; }).field == BodyField::max_angle);
    CHECK(region_fault([](RegionInput& r) { r.rest_direction = 1e300; }) ==
          BodyFault{BodyField::rest_direction, Reason::out_of_range, 0});
    CHECK(region_fault([](RegionInput& r) { r.max_angle = r.rest_angle = 5; }).field ==
          BodyField::rest_angle);
    CHECK(region_fault([](RegionInput& r) { r.table.max_angle = 1e-40f; }).field == BodyField::table);
    CHECK(region_fault([](RegionInput& r) { r.table.rows[1][0] = 3e38f; }) ==
          BodyFault{BodyField::table, Reason::out_of_range, 0});
    CHECK(region_fault([](RegionInput& r) { r.table.rows[0][7] = 1e9f; }).none());
    CHECK(region_fault([](RegionInput& r) {  // divided by the seventh power of a small kappa
              r.table.rows[0][7] = 1e9f;
              r.onset = 0.1;
          })
              .field == BodyField::table);
    CHECK(vertex_fault([](RestVertex& v) { v.rho = 1e13; }).field == BodyField::rho);
    CHECK(vertex_fault([](RestVertex& v) { v.rho = 1e5; }).field == BodyField::rho);
    CHECK(vertex_fault([](RestVertex& v) { v.rho = 1e-300; }).none());
    CHECK(vertex_fault([](RestVertex& v) { v.wrinkle = -1e19; }).field == BodyField::wrinkle);
    CHECK(vertex_fault([](RestVertex& v) { v.slope = 1e300; }).field == BodyField::slope);
    const auto wrinkled = [](auto change) {
        return fault_of([&](BodyInput&, Parts& p) {
            p.regions[0].table.rows[1][0] = 1;
            change(p.vertices[1]);
        });
    };
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = v.slope = 1e3; }).none());
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = 1e8; }).field == BodyField::wrinkle);
    CHECK(wrinkled([](RestVertex& v) { v.slope = -1e8; }).field == BodyField::slope);
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = 1e6; }).field == BodyField::rho);
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = 2e4; }).none());
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = 1e4, v.scale_slope = -1e3; }).none());
    CHECK(wrinkled([](RestVertex& v) { v.wrinkle = 2e4, v.scale_slope = -1e3; }) ==
          BodyFault{BodyField::scale_slope, Reason::out_of_range, 1});
}

TEST_CASE("a body's fault says the field, the place and the reason") {
    CHECK(text_of({}) == "no fault");
    CHECK(text_of({BodyField::max_angle, Reason::not_finite, 2}).find("regions[2].max_angle: not finite; ") ==
          0);
    CHECK(text_of({BodyField::rho, Reason::out_of_range, 123}).find("vertices[123].rho: out of range; ") ==
          0);
    CHECK(text_of({BodyField::normals, Reason::count, nowhere}).find("normals: wrong number; ") == 0);
    CHECK(text_of({BodyField::normals, Reason::out_of_range, 7}).find("normals[7]: out of range; ") == 0);
    CHECK(text_of({BodyField::radius, Reason::out_of_range, nowhere}).find("radius: out of range; ") == 0);
    for (int i = 1; i <= static_cast<int>(BodyField::tangent_signs); ++i) {
        const std::string text =
            text_of({static_cast<BodyField>(i), Reason::out_of_range, ~std::size_t{0} - 1});
        CHECK(text.find("unknown") == std::string::npos);
        CHECK(text.size() + 1 < sizeof(bend::FaultText::text));
    }
    CHECK(text_of({static_cast<BodyField>(200), Reason::count, 0}).find("unknown") != std::string::npos);
}

TEST_CASE("an empty body has nothing, and one moved from is empty") {
    const auto check_empty = [](const Body& body) {
        CHECK(body.empty());
        CHECK(body.data() == nullptr);
        CHECK(body.vertex_count() == 0);
        CHECK(body.region_count() == 0);
        CHECK(body.regions().empty());
        CHECK(body.region_inputs().empty());
        CHECK_FALSE(body.has_tangents());
        CHECK(body.length() == 0);
        CHECK(body.radius() == 0);
        CHECK(body.bytes() == sizeof(Body));
        CHECK(body.axes() == glm::dmat3(1));
        CHECK(body.origin() == glm::dvec3(0));
    };
    check_empty(Body());
    Body first = std::move(Body::make(Parts().input()).value());
    const bend::BodyData* data = first.data();
    Body second = std::move(first);
    check_empty(first);
    CHECK(second.data() == data);
    first = std::move(second);
    check_empty(second);
    CHECK(first.vertex_count() == 2);
}

TEST_CASE("a body says what it was made from, unrounded") {
    Parts parts;
    parts.regions.push_back(parts.regions[0]);
    parts.regions[0].vertex_count = parts.regions[1].vertex_count = 1;
    RegionInput& tip = parts.regions[1];
    tip.length = 1 + 1e-13;
    tip.max_angle = 2 + 1e-13;
    tip.rest_angle = 1 / 3.0;
    tip.rest_direction = -2 / 3.0;
    tip.onset = 1e-3;
    tip.table.rows[1][5] = 0.25f;
    tip.factors.max_angle = 1;
    tip.factors.rows.resize(3);
    BodyInput input = parts.input();
    input.origin = {0.1, 1 / 3.0, -7};
    const Body body = std::move(Body::make(input).value());
    CHECK(body.vertex_count() == 2);
    CHECK(body.has_tangents());
    CHECK(body.length() == 2 + 1e-13);
    CHECK(body.radius() == 0.1);
    CHECK(body.origin() == input.origin);
    REQUIRE(body.region_count() == 2);
    CHECK(body.regions()[1].first == 1);
    CHECK(body.regions()[1].last == 2);
    CHECK(body.regions()[1].length == 1.0f);
    CHECK(body.max_angle(1) == 2.0f);
    CHECK(body.rest_pose(1).angle == static_cast<float>(1 / 3.0));
    CHECK(body.bytes() > sizeof(Body) + 18 * 2 * sizeof(float));
    const std::span<const RegionInput> given = body.region_inputs();
    REQUIRE(given.size() == 2);
    CHECK(given[0].vertex_count == 1);
    CHECK(given[1].length == tip.length);
    CHECK(given[1].max_angle == tip.max_angle);
    CHECK(given[1].rest_angle == tip.rest_angle);
    CHECK(given[1].rest_direction == tip.rest_direction);
    CHECK(given[1].onset == tip.onset);
    CHECK(given[1].table.rows == tip.table.rows);
    CHECK(given[1].table.max_angle == tip.table.max_angle);
    CHECK(given[1].factors.rows == tip.factors.rows);
    CHECK(given[1].vertex_count == 1);
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

TEST_CASE("tables survive any angle and any direction") {
    bend::WrinkleTable wrinkles;
    bend::FactorTable factors;
    wrinkles.max_angle = factors.max_angle = 2;
    wrinkles.rows.resize(5);
    factors.rows.resize(5);
    for (std::size_t i = 0; i < 5; ++i) {
        wrinkles.rows[i].fill(static_cast<float>(i));
        for (std::size_t d = 0; d < bend::FactorTable::directions; ++d)
            factors.rows[i][d] = static_cast<float>(1 + d);
    }
    const float not_a_number = nan, infinite = infinity;
    for (const float bad : {not_a_number, infinite, -infinite}) {
        CHECK(wrinkles.at(bad)[0] == 0.0f);
        CHECK(factors.at(bad, 0) == 1.0f);
        CHECK(factors.at(1, bad) == 1.0f);
    }
    CHECK(wrinkles.at(3e38f)[0] == 4.0f);
    std::mt19937 random(5);
    const auto any_float = [&] {
        const auto bits = static_cast<std::uint32_t>(random());
        float value;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
    };
    const auto survives = [&](float angle, float direction) {
        const float amplitude = wrinkles.at(angle)[7], factor = factors.at(angle, direction);
        REQUIRE((amplitude >= 0 && amplitude <= 4));
        REQUIRE((factor >= 1 && factor <= 4));
    };
    for (int i = 0; i < 100'000; ++i) survives(any_float(), any_float());
    for (const float direction : {-1e-30f, -1e-8f, 3.4e38f, -3.4e38f, 1e20f, 6.2831853f, -6.2831853f})
        survives(1, direction);
    for (const float no_angle : {0.0f, -1.0f, 1e-45f, not_a_number, infinite}) {
        wrinkles.max_angle = factors.max_angle = no_angle;
        for (const float angle : {0.0f, 1.0f, -1.0f, not_a_number, infinite}) survives(angle, 1);
    }
    wrinkles.rows.resize(1);
    factors.rows.resize(1);
    survives(1, 1);
}

}  // namespace goffer::test
