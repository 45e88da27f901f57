// SPDX-License-Identifier: MIT
#pragma once

#include "stage.hpp"

#include <cstddef>
#include <functional>

/// The floor: a fill of the bytes that a case writes, by as many threads, which no output can be had for
/// less than.

namespace goffer::bench {

/// How many times the floor of a case is run: fills `floats` floats of the stage's memory, in the arena that
/// it is called from where `threads` > 1. As bend::Stores::automatic does, it goes past the cache where the
/// output is larger than the cache.
[[nodiscard]] std::function<void(std::size_t)> floor_of(Stage& stage, std::size_t floats, int threads);

}  // namespace goffer::bench
