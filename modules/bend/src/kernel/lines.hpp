// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <cstddef>
#include <cstdint>

namespace goffer::bend {

/// The number of floats from `at` to the next address that begins a cache line, 0 to line_floats - 1. A
/// template on its caller's type, so that each instruction set has its own.
template <class Asker>
std::size_t floats_to_line(const float* at) noexcept {
    return (0 - reinterpret_cast<std::uintptr_t>(at) / sizeof(float)) % line_floats;
}

/// How many records ahead their lines are asked for. A record whose gaps are kept is not written whole, so
/// that its line is read first; some processors do not foresee that, and wait for memory.
constexpr std::size_t records_ahead = 128;

/// Asks for the lines of `count` records, `stride` floats each.
template <class L>
void prefetch_records(const float* first, std::size_t count, std::size_t stride) {
    const std::size_t step = stride < line_floats ? line_floats : stride;
    for (std::size_t i = 0; i < count * stride; i += step) L::prefetch(first + i);
}

}  // namespace goffer::bend
