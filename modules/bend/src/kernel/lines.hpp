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

}  // namespace goffer::bend
