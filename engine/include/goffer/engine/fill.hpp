// SPDX-License-Identifier: MIT
#pragma once

#include <span>

/// Filling memory: the least that an output of so many bytes can cost, which other outputs are measured
/// against.

namespace goffer {

/// Sets every float of `to`, the caller's memory, to `value`. `streaming`: whole cache lines go past the
/// cache with non-temporal stores where there are such (x86-64), and are visible to other threads on return;
/// floats before the first and behind the last whole line are stored as usual. Does not allocate. Thread-safe
/// where ranges do not overlap.
void fill(std::span<float> to, float value, bool streaming) noexcept;

}  // namespace goffer
