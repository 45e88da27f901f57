// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/lines.hpp"

/// Copies floats to whole cache lines. `L` is lanes of single registers.

namespace goffer::bend {

template <class L>
void copy_floats(const float* from, float* to, std::size_t count) {
    std::size_t i = 0;
    for (; i + L::width <= count; i += L::width) L::store(to + i, L::load(from + i));
    for (; i < count; ++i) to[i] = from[i];
}

template <class L>
GOFFER_FLATTENED void copy_lines(const float* from, float* to, std::size_t count, bool non_temporal) {
    if (!non_temporal) return copy_floats<L>(from, to, count);
    std::size_t before = floats_to_line<L>(to);
    before = before < count ? before : count;
    copy_floats<L>(from, to, before);
    const std::size_t lines = (count - before) / line_floats * line_floats;
    for (std::size_t i = before; i < before + lines; i += L::width) L::stream(to + i, L::load(from + i));
    copy_floats<L>(from + before + lines, to + before + lines, count - before - lines);
}

}  // namespace goffer::bend
