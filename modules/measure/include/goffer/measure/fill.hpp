// SPDX-License-Identifier: MIT
#pragma once

#include <span>

/// Filling and copying memory: the least that an output of so many bytes can cost, which other outputs are
/// measured against. A copy is that for outputs which leave gaps in cache lines: these are read, too.
///
/// `non_temporal`: whole cache lines go past the cache where there are such stores (x86-64), and are visible
/// to other threads on return; floats before the first and behind the last whole line are stored as usual.

namespace goffer::measure {

/// Sets every float of `to`, the caller's memory, to a number from 1 to 2 that differs from its neighbors':
/// memory that is all zeros or all one number is something that some machines are faster with. The numbers
/// repeat every four cache lines: they depend on `seed` and on a float's address, and not on where `to`
/// begins. Does not allocate. Thread-safe where ranges do not overlap.
void fill(std::span<float> to, float seed, bool non_temporal) noexcept;

/// Copies `from` to the beginning of `to`, which is as long or longer, and does not overlap it. Does not
/// allocate. Thread-safe where ranges that are written overlap no others.
void copy(std::span<const float> from, std::span<float> to, bool non_temporal) noexcept;

/// The same, with oneTBB where `threads` > 1: in the caller's arena, which should be of so many. On the
/// calling thread where it is less.
void fill(std::span<float> to, float seed, bool non_temporal, int threads);
void copy(std::span<const float> from, std::span<float> to, bool non_temporal, int threads);

}  // namespace goffer::measure
