// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "body_files.hpp"

#include <goffer/measure/allocations.hpp>
#include <goffer/measure/timer.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

/// What loading costs: nothing in proportion to the vertices, with Verify::layout.

namespace goffer::test {
namespace {

/// A file of a body of so many vertices, in memory as a mapped one lies there.
AlignedBytes file_of(std::size_t vertices) {
    Random random(61);
    const bend::Body body = loose_body(random, vertices);
    return AlignedBytes(saved(body));
}

/// The same of a body of three regions whose folds run on over the joints.
AlignedBytes file_of_chain(int columns, int rows) {
    Random random(62);
    const TestMesh mesh = random_mesh(random, 10, 1, columns, rows, 0);
    fit::BindOptions options;
    options.regions = {{0.3}, {0.3}, {0.4}};
    const fit::Binding binding = fit::bind(mesh.geometry(), mesh.cylinder, options);
    REQUIRE(binding.regions[0].blend > 0);
    REQUIRE(binding.regions[1].blend > 0);
    const bend::LevelInput level{&binding.body, {}};
    return AlignedBytes(bend::save({{&level, 1}, {}, {}, {}}));
}

BodyFile loaded(const AlignedBytes& file) {
    return bend::load(file.bytes(), nullptr, bend::Verify::layout).value();
}

/// The allocations of a load.
std::optional<std::uint64_t> allocations_of(const AlignedBytes& file) {
    const auto before = measure::allocations();
    const BodyFile made = loaded(file);
    const auto after = measure::allocations();
    return before ? std::optional(*after - *before) : std::nullopt;
}

bool within(std::span<const std::byte> part, std::span<const std::byte> all) {
    return part.data() >= all.data() && part.data() + part.size() <= all.data() + all.size();
}

void check_cost(const AlignedBytes& small, const AlignedBytes& large) {
    const auto few = allocations_of(small), many = allocations_of(large);
    if (!few) {
        MESSAGE("skipped: something else counts allocations here, and may take its time");
        return;
    }
    CHECK(few == many);
    double best = std::numeric_limits<double>::max();
    for (int i = 0; i < 200; ++i)
        best = std::min(best, measure::nanoseconds_of(1, [&] { (void)loaded(large); }));
    CHECK(best < 100e3);
    MESSAGE(*many, " allocations, ", 1e-3 * best, " us");
}

}  // namespace

TEST_CASE("body file: columns and triangles are used where they lie") {
    const AlignedBytes file = file_of(1000);
    const BodyFile made = loaded(file);
    const bend::BodyData& data = *made.levels[0].body.data();
    const std::span columns(data.columns.cos_half_beta, data.layout.columns() * data.stride);
    CHECK(within(std::as_bytes(columns), file.bytes()));
    CHECK(within(std::as_bytes(made.levels[0].mesh.triangles), file.bytes()));
    CHECK(made.levels[0].body.bytes() < columns.size_bytes() / 10);
}

TEST_CASE("body file: to load 100,000 vertices takes no more allocations than 1,000, and below 100 us") {
    check_cost(file_of(1000), file_of(100'000));
    check_cost(file_of_chain(12, 121), file_of_chain(250, 401));
}

}  // namespace goffer::test
