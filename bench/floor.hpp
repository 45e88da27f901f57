// SPDX-License-Identifier: MIT
#pragma once

#include "fixture.hpp"

#include <goffer/measure/stream_layout.hpp>

#include <cstddef>
#include <functional>

/// The floor: what no output can be had for less than, by as many threads. That is a fill of the bytes that a
/// case writes. Where it leaves gaps in what it writes, cache lines are read, and written back whole: then it
/// is a copy of as many.

namespace goffer::bench {

/// The floor of a case: a function of how many times it is run, in the arena that it is called from where
/// `threads` > 1. Into `vertices` vertices of the fixture's memory, in `layout`; past the cache where
/// bend::Stores::automatic goes there.
[[nodiscard]] std::function<void(std::size_t)> floor_of(Fixture& fixture, const measure::StreamLayout& layout,
                                                        std::size_t vertices, int threads);

}  // namespace goffer::bench
