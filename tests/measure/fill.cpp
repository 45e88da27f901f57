// SPDX-License-Identifier: MIT
#include "support/arena.hpp"

#include <goffer/engine/columns.hpp>
#include <goffer/measure/fill.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Fills and copies write all of their range and nothing beside it, wherever in a cache line it begins and
/// ends.

namespace goffer::test {
namespace {

constexpr std::size_t line = column_alignment / sizeof(float);
constexpr float untouched = -7;

/// Calls check(range, non_temporal) for ranges of `memory` with every beginning and end in a line, which is
/// `untouched` before each.
template <class Check>
void each_range(const Check& check) {
    Columns memory(1, 8 * line);  // begins on a line
    for (const bool non_temporal : {false, true}) {
        for (std::size_t offset = 0; offset < line; ++offset) {
            for (std::size_t size = 0; size <= 6 * line; ++size) {
                std::ranges::fill(memory[0], untouched);
                CAPTURE(offset);
                CAPTURE(size);
                CAPTURE(non_temporal);
                check(memory[0].subspan(line + offset, size), non_temporal);
                const auto beside = [&](std::span<const float> part) {
                    return std::ranges::all_of(part, [](float value) { return value == untouched; });
                };
                REQUIRE(beside(memory[0].first(line + offset)));
                REQUIRE(beside(memory[0].subspan(line + offset + size)));
            }
        }
    }
}

bool is_filled(std::span<const float> range) {
    return std::ranges::all_of(range, [](float value) { return value >= 1 && value < 2; }) &&
           std::ranges::adjacent_find(range) == range.end();
}

}  // namespace

TEST_CASE("a fill writes its range and nothing beside it, and neighbors differ") {
    each_range([](std::span<float> range, bool non_temporal) {
        measure::fill(range, 0.25f, non_temporal);
        REQUIRE(is_filled(range));
    });
}

TEST_CASE("a fill's numbers vary with every seed, and from seed to seed") {
    Columns memory(2, 4 * line);
    for (const float seed : {0.0f, -0.0f, 1.0f, 1e30f, -1e-40f, std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()}) {
        measure::fill(memory[0], seed, true);
        CHECK(is_filled(memory[0]));
    }
    measure::fill(memory[0], 1, false);
    measure::fill(memory[1], 2, false);
    CHECK_FALSE(std::ranges::equal(memory[0], memory[1]));
}

TEST_CASE("a fill in parts is the fill of the whole, past the cache or not") {
    Columns memory(2, 20 * line);
    const std::span<float> whole = memory[0], parts = memory[1];
    measure::fill(whole, 3, false);
    // Columns begin at different lines of the pattern.
    const std::size_t shift = static_cast<std::size_t>(parts.data() - whole.data()) % (4 * line);
    for (std::size_t first = 0, size = 1; first < parts.size(); first += size, size = size * 3 % 41) {
        size = std::min(size, parts.size() - first);
        measure::fill(parts.subspan(first, size), 3, size % 2 == 0);
    }
    const std::size_t common = parts.size() - 4 * line;
    CHECK(std::ranges::equal(parts.first(common), whole.subspan(shift, common)));
}

TEST_CASE("threads share a fill and a copy") {
    Columns memory(3, 1000 * line + 5);
    const std::span<float> whole = memory[0], shared = memory[1], copied = memory[2];
    in_arena(2, [&] {
        measure::fill(shared, 3, true, 2);
        measure::copy(shared, copied, true, 2);
    });
    CHECK(is_filled(shared));
    CHECK(std::ranges::equal(shared, copied));
    measure::fill(whole, 3, false, 1);
    const std::size_t shift = static_cast<std::size_t>(shared.data() - whole.data()) % (4 * line);
    const std::size_t common = shared.size() - 4 * line;
    CHECK(std::ranges::equal(shared.first(common), whole.subspan(shift, common)));
}

TEST_CASE("a copy writes its range and nothing beside it, from wherever it is read") {
    std::vector<float> source(7 * line);
    for (std::size_t i = 0; i < source.size(); ++i) source[i] = static_cast<float>(i);
    for (const std::size_t from : {0u, 1u, 7u}) {
        each_range([&](std::span<float> range, bool non_temporal) {
            const auto part = std::span<const float>(source).subspan(from, range.size());
            measure::copy(part, range, non_temporal);
            REQUIRE(std::ranges::equal(part, range));
        });
    }
}

}  // namespace goffer::test
