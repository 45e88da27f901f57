// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/deform_batch.hpp"

#include <cstddef>

/// Kernels for the line of each plane in which one instance ends and the next one begins. Written by the
/// kernels of both, it would be written in part twice, and be read from memory before. `L` is lanes of one
/// line.

namespace goffer::bend {

/// Writes a line whose first `count` values are of `ending`, and the others of `beginning`.
template <class L>
void stream_spliced(float* const* planes, std::size_t at, const Vector<L>& ending, const Vector<L>& beginning,
                    std::size_t count) {
    for (int c = 0; c < 3; ++c)
        L::stream(planes[c] + at, L::spliced(ending.component[c], beginning.component[c], count));
}

template <class L, Squeeze squeeze, StreamSet streams>
GOFFER_FLATTENED void bend_shared_line(const RestColumns& columns, const Coefficients& ending,
                                       const Coefficients& beginning, const PlaneOutput& out,
                                       std::size_t out_first, std::size_t first, std::size_t count) {
    static_assert(L::width == line_floats);
    const RestColumns rest = columns;
    const Coefficients* const k[2] = {&ending, &beginning};
    const std::size_t begins[2] = {first, 0};
    Results<L> results[2];
    for (int i = 0; i < 2; ++i) {
        const Bent<L> bent = turn_batch<L, squeeze, has_normals(streams)>(rest, *k[i], begins[i]);
        results[i] = deform_batch<L, squeeze, streams>(rest, *k[i], bent, begins[i]);
    }
    stream_spliced<L>(out.position, out_first, results[0].position, results[1].position, count);
    if constexpr (has_normals(streams))
        stream_spliced<L>(out.normal, out_first, results[0].normal, results[1].normal, count);
}

}  // namespace goffer::bend
