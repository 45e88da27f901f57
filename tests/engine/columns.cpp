// SPDX-License-Identifier: MIT
#include "support/sanitized.hpp"

#include <goffer/engine/columns.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

/// Columns: aligned, padded with zeros, apart from each other.

namespace goffer::test {

TEST_CASE("columns begin on cache lines, and zeros follow as far as a kernel reads") {
    for (const std::size_t count : {0u, 1u, 31u, 32u, 992u, 1000u, 4096u}) {
        CAPTURE(count);
        Columns columns(3, count);
        CHECK(columns.columns() == 3);
        CHECK(columns.count() == count);
        CHECK(columns.bytes() >= 3 * (count + widest_batch) * sizeof(float));
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(columns[c].size() == count);
            CHECK(reinterpret_cast<std::uintptr_t>(columns[c].data()) % column_alignment == 0);
            std::ranges::fill(columns[c], 1.0f);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const float* const behind = columns[c].data() + count;
            CHECK(std::all_of(behind, behind + widest_batch, [](float value) { return value == 0; }));
            CHECK(std::ranges::all_of(columns[c], [](float value) { return value == 1; }));
        }
    }
}

TEST_CASE("columns are not a multiple of a page apart") {
    for (const std::size_t count : {992u, 1024u, 2016u, 4064u}) {
        const Columns columns(2, count);
        const auto apart = columns[1].data() - columns[0].data();
        CHECK(apart * static_cast<std::ptrdiff_t>(sizeof(float)) % 4096 != 0);
    }
}

TEST_CASE("columns move with their memory") {
    Columns from(2, 10);
    from[1][3] = 7;
    const float* const memory = from[1].data();
    const Columns to = std::move(from);
    CHECK(to[1].data() == memory);
    CHECK(to[1][3] == 7);
    CHECK(Columns().columns() == 0);
    CHECK(Columns().bytes() == 0);
    CHECK(Columns(0, 5).bytes() == 0);
}

// Sanitizers end the program there.
TEST_CASE("columns of more bytes than there are numbers for are refused, as any without memory for them" *
          doctest::skip(sanitized)) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    for (const std::pair<std::size_t, std::size_t>& size : {std::pair{std::size_t{1}, most - 10},
                                                            {std::size_t{4}, most / 8},
                                                            {most / 64, std::size_t{100}},
                                                            {most, std::size_t{1}},
                                                            {std::size_t{1}, most / 8},
                                                            {std::size_t{1}, most}}) {
        CAPTURE(size.first);
        CAPTURE(size.second);
        CHECK_THROWS_AS(Columns(size.first, size.second), std::bad_alloc);
    }
}

}  // namespace goffer::test
