// SPDX-License-Identifier: MIT
#include <goffer/engine/parallel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

/// Loops over ranges.

namespace goffer {
namespace {

using Range = std::pair<std::size_t, std::size_t>;

/// In order.
std::vector<Range> ranges_of(std::size_t count, std::size_t grain) {
    std::mutex mutex;
    std::vector<Range> ranges;
    parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
        const std::lock_guard lock(mutex);
        ranges.emplace_back(first, last);
    });
    std::ranges::sort(ranges);
    return ranges;
}

}  // namespace

TEST_CASE("ranges cover all elements once, none of them shorter than half the grain") {
    for (const std::size_t grain : {0u, 1u, 2u, 7u, 64u, 1000u}) {
        for (const std::size_t count : {0u, 1u, 3u, 63u, 64u, 65u, 129u, 1001u, 20000u}) {
            CAPTURE(grain);
            CAPTURE(count);
            std::size_t next = 0;
            for (const auto& [first, last] : ranges_of(count, grain)) {
                CHECK(first == next);
                CHECK(last > first);
                CHECK(2 * (last - first) >= std::min(grain, 2 * count));
                next = last;
            }
            CHECK(next == count);
        }
    }
}

}  // namespace goffer
