// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <cstddef>
#include <cstdint>

namespace goffer::bend {

/// How many floats from `at` on lie before the next cache line, below line_floats. A template on whatever
/// asks, so that every instruction set has its own.
template <class Asker>
std::size_t floats_to_line(const float* at) noexcept {
    return (0 - reinterpret_cast<std::uintptr_t>(at) / sizeof(float)) % line_floats;
}

}  // namespace goffer::bend
