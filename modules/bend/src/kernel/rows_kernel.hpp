// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/lines.hpp"

#include <cstddef>

/// Writes planes as rows: members of records that hold other things too. `L` is lanes of single registers.

namespace goffer::bend {

/// Writes `vertices` rows of N values, at most a register of each plane, four values of all of them at a
/// time.
template <class L, int N, int first = 0>
void write_some(const float* const* planes, std::size_t at, std::byte* row, std::size_t stride,
                std::size_t vertices) {
    constexpr int values = N - first < 4 ? N - first : 4;
    const auto plane = [&](int c) { return L::load(planes[first + (c < values ? c : 0)] + at); };
    L::for_rows(plane(0), plane(1), plane(2), plane(3), [&](std::size_t i, typename L::Row four) {
        float* const to = reinterpret_cast<float*>(row + i * stride) + first;
        if (i < vertices) L::template store_row_first<values>(to, four);
    });
    if constexpr (first + 4 < N) write_some<L, N, first + 4>(planes, at, row, stride, vertices);
}

template <class L, int N>
GOFFER_FLATTENED void write_rows(const float* const* planes, std::size_t count, float* first,
                                 std::size_t stride) {
    const float* from[N];
    for (std::size_t c = 0; c < N; ++c) from[c] = planes[c];
    auto* row = reinterpret_cast<std::byte*>(first);
    std::size_t i = 0;
    for (; i + L::width <= count; i += L::width, row += L::width * stride) {
        prefetch_records<L>(reinterpret_cast<const float*>(row + records_ahead * stride), L::width,
                            stride / sizeof(float));
        write_some<L, N>(from, i, row, stride, L::width);
    }
    if (i < count) write_some<L, N>(from, i, row, stride, count - i);
}

}  // namespace goffer::bend
