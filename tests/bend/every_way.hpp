// SPDX-License-Identifier: MIT
#pragma once

#include "pieces.hpp"
#include "support/arena.hpp"
#include "support/test_batch.hpp"

#include <doctest/doctest.h>

#include <cstddef>

namespace goffer::test {

/// Runs the crowd of `tested` whole, in pieces, and in parallel: each time it must leave what its instances
/// leave one by one.
inline void check_every_way(TestBatches& tested, const bend::CrowdJob& crowd, std::size_t pieces) {
    const bend::CrowdResult expected = tested.expect(crowd.isa, crowd.frame);
    const auto check = [&](const auto& run) {
        tested.clear();
        const bend::CrowdResult result = run();
        REQUIRE(tested.fault(crowd.frame) == "");
        REQUIRE(result.deformed == expected.deformed);
        REQUIRE(result.clamped == expected.clamped);
        REQUIRE(result.at_rest == expected.at_rest);
    };
    check([&] { return bend::run(crowd); });
    check([&] { return run_pieces(crowd, 0, 1, pieces); });
    check([&] {
        bend::CrowdResult result;
        in_arena(2, [&] { result = bend::run_parallel(crowd); });
        return result;
    });
}

}  // namespace goffer::test
