// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/record_kernel.hpp"

#include <cstddef>

/// Kernels that deform vertices to two poses at a time, and weave the vectors of both in registers.

namespace goffer::bend {

/// Records of a previous position, a current one and, if wanted, a normal, in the order that `order` says.
template <class L, bool normals, PairOrder order>
struct PairLayout {
    static constexpr int vectors = normals ? 3 : 2;
    static constexpr int floats = 3 * vectors;

    /// The vector at that place: 0 is the previous position, 1 the current one, 2 the normal.
    static constexpr int vector_at(int place) {
        constexpr int first = static_cast<int>(order) / 2;
        constexpr bool swapped = static_cast<int>(order) % 2 != 0;
        constexpr int low = first == 0 ? 1 : 0, high = first == 2 ? 1 : 2;
        if (place == 0) return first;
        return (place == 1) != swapped ? low : high;
    }
};

/// Stores a unit of both poses as records.
template <class L, bool normals, PairOrder order>
void store_pairs(const Results<L> (&now)[batches<L>], const Results<L> (&before)[batches<L>], float* to,
                 bool non_temporal) {
    using Layout = PairLayout<L, normals, order>;
    using Single = typename L::Single;
    for (std::size_t b = 0; b < batches<L>; ++b) {
        const Vector<L>* const vectors[] = {&before[b].position, &now[b].position, &now[b].normal};
        for (std::size_t part = 0; part < L::width / Single::width; ++part) {
            typename Single::Vec planes[Layout::floats];
            for (int i = 0; i < Layout::floats; ++i)
                planes[i] = L::single(vectors[Layout::vector_at(i / 3)]->component[i % 3], part);
            store_records<Single, Layout::floats>(planes, to, non_temporal);
            to += Layout::floats * Single::width;
        }
    }
}

/// The same in the order that a call is told of.
template <class L, bool normals>
void store_pairs(const Results<L> (&now)[batches<L>], const Results<L> (&before)[batches<L>], PairOrder order,
                 float* to, bool non_temporal) {
    const auto store_as = [&]<PairOrder known>() {
        store_pairs<L, normals, known>(now, before, to, non_temporal);
    };
    if (order == PairOrder::previous_position_normal)
        return store_as.template operator()<PairOrder::previous_position_normal>();
    if constexpr (normals) {
        if (order == PairOrder::previous_normal_position)
            return store_as.template operator()<PairOrder::previous_normal_position>();
        if (order == PairOrder::position_normal_previous)
            return store_as.template operator()<PairOrder::position_normal_previous>();
        if (order == PairOrder::normal_previous_position)
            return store_as.template operator()<PairOrder::normal_previous_position>();
        if (order == PairOrder::normal_position_previous)
            return store_as.template operator()<PairOrder::normal_position_previous>();
    }
    store_as.template operator()<PairOrder::position_previous_normal>();
}

// Coefficients are read again for each unit, since those of two poses do not fit into registers.
template <class L, Squeeze squeeze, bool normals>
GOFFER_FLATTENED void bend_to_pairs(const RestColumns& columns, const Coefficients& current,
                                    const Coefficients& previous, const PairOutput& output, std::size_t first,
                                    std::size_t vertices, Write write) {
    constexpr StreamSet streams = normals ? StreamSet::positions_normals : StreamSet::positions;
    constexpr std::size_t floats = normals ? 9 : 6;
    const RestColumns rest = columns;
    const PairOutput out = output;
    const bool non_temporal = write == Write::non_temporal;
    if (non_temporal) prefetch_ends<L>(out.first, floats * vertices);
    alignas(64) float part[floats * unit<L>];
    const auto store = [&](const Results<L>(&now)[batches<L>], std::size_t j, std::size_t count) {
        const Coefficients& k = reread<L>(previous);
        Results<L> before[batches<L>];
        for (std::size_t b = 0; b < batches<L>; ++b) {
            const std::size_t i = first + j + b * L::width;
            before[b] = deform_batch<L, squeeze, StreamSet::positions>(
                rest, k, turn_batch<L, squeeze, false>(rest, k, i), i);
        }
        float* const to = out.first + floats * j;
        const bool whole = count == unit<L>;
        store_pairs<L, normals>(now, before, out.order, whole ? to : part, whole && non_temporal);
        if (!whole) [[unlikely]]
            copy_dense<L>(part, floats * count, to, non_temporal);
    };
    deform_units<L, squeeze, streams, true>(rest, current, first, vertices,
                                            out.peeled != 0 ? out.peeled : unit<L>, store);
}

}  // namespace goffer::bend
