// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/bend_kernel.hpp"
#include "kernel/weave.hpp"

#include <cstddef>

/// The same kernels, which write records. A position and a normal, with gaps or without, are woven in
/// registers, and in pair_kernel.hpp previous positions beside them; what else a record may hold goes through
/// the staging buffer.

namespace goffer::bend {

/// Records of a kernel's vectors. (A template on the lanes, so that each instruction set has its own.)
template <class L, StreamSet streams, RecordGaps gaps>
struct RecordLayout {
    static constexpr int values = streams == StreamSet::positions_normals ? 6 : 3;
    static constexpr int step = gaps == RecordGaps::one_behind_each ? 4 : 3;  // from vector to vector
    static constexpr int floats = gaps == RecordGaps::two_behind_all ? values + 2 : values / 3 * step;

    static constexpr int place(int value) { return value / 3 * step + value % 3; }
    /// How many floats of row g of a record, of four, hold values: the first ones.
    static constexpr int values_in_row(int g) {
        return step == 4 ? 3 : values - 4 * g < 4 ? values - 4 * g : 4;
    }
};

/// Stores a unit as records: into the cache, what is between gaps alone.
template <class L, StreamSet streams, RecordGaps gaps>
void store_unit(const Results<L> (&results)[batches<L>], float* to, bool non_temporal) {
    using Single = typename L::Single;
    using Layout = RecordLayout<L, streams, gaps>;
    for (std::size_t b = 0; b < batches<L>; ++b) {
        for (std::size_t part = 0; part < L::width / Single::width; ++part) {
            typename Single::Vec planes[Layout::floats];
            for (int i = 0; i < Layout::floats; ++i) planes[i] = Single::splat(0.0f);
            for (int i = 0; i < Layout::values; ++i) {
                const Vector<L>& from = i < 3 ? results[b].position : results[b].normal;
                planes[Layout::place(i)] = L::single(from.component[i % 3], part);
            }
            if constexpr (gaps == RecordGaps::none) {
                store_records<Single, Layout::floats>(planes, to, non_temporal);
            } else if (non_temporal) {
                store_rows<Single, Layout::floats>(planes, to, true);
            } else {
                store_rows_between<Single, Layout::floats, Layout>(planes, to);
            }
            to += Layout::floats * Single::width;
        }
    }
}

/// The same with the gaps that a call is told of.
template <class L, StreamSet streams>
void store_unit(const Results<L> (&results)[batches<L>], RecordGaps gaps, float* to, bool non_temporal) {
    if (streams == StreamSet::packed || gaps == RecordGaps::none)
        return store_unit<L, streams, RecordGaps::none>(results, to, non_temporal);
    if constexpr (streams == StreamSet::positions_normals) {
        if (gaps == RecordGaps::two_behind_all)
            return store_unit<L, streams, RecordGaps::two_behind_all>(results, to, non_temporal);
    }
    if constexpr (streams != StreamSet::packed)
        store_unit<L, streams, RecordGaps::one_behind_each>(results, to, non_temporal);
}

/// Copies records without gaps, whole lines past the cache if `to` begins one.
template <class L>
void copy_dense(const float* from, std::size_t count, float* to, bool non_temporal) {
    using Single = typename L::Single;
    std::size_t i = 0;
    if (non_temporal && floats_to_line<L>(to) == 0) {
        const std::size_t whole = count / line_floats * line_floats;
        for (; i < whole; i += Single::width) Single::stream(to + i, Single::load(from + i));
    }
    for (; i < count; ++i) to[i] = from[i];
}

/// Copies `count` records without gaps to some that have them.
template <class L>
void copy_between_gaps(const float* from, std::size_t count, const RecordOutput& out, float* to) {
    const bool after_each = out.gaps == RecordGaps::one_behind_each;
    for (std::size_t v = 0; v < count; ++v, to += out.stride) {
        for (std::size_t i = 0; i < out.stride; ++i) {
            const bool in_gap = after_each ? i % 4 == 3 : i >= 6;
            if (!in_gap) to[i] = *from++;
        }
    }
}

template <class L, Squeeze squeeze, StreamSet streams>
GOFFER_FLATTENED void bend_to_records(const RestColumns& columns, const Coefficients& coefficients,
                                      const RecordOutput& output, std::size_t first, std::size_t vertices,
                                      Write write) {
    using Dense = RecordLayout<L, streams, RecordGaps::none>;
    if (vertices == 0) return;  // as bend_to_planes has it
    const RestColumns rest = columns;
    const Coefficients k = coefficients;
    const RecordOutput out = output;
    const bool non_temporal = write == Write::non_temporal;
    const bool asks_ahead = out.gaps != RecordGaps::none && !non_temporal;
    if (non_temporal) prefetch_ends<L>(out.first, out.stride * vertices);
    const auto store = [&](const Results<L>(&results)[batches<L>], std::size_t j, std::size_t count) {
        float* const to = out.first + out.stride * j;
        if constexpr (streams != StreamSet::packed) {
            if (asks_ahead)
                prefetch_records<typename L::Single>(to + records_ahead * out.stride, unit<L>, out.stride);
        }
        if (count == unit<L>) [[likely]] {
            const bool keeps_gap = out.keeps_last_gap && j + count == vertices;
            return store_unit<L, streams>(results, out.gaps, to, non_temporal && !keeps_gap);
        }
        alignas(64) float part[Dense::floats * unit<L>];
        store_unit<L, streams, RecordGaps::none>(results, part, false);
        if (streams == StreamSet::packed || out.gaps == RecordGaps::none) {
            copy_dense<L>(part, Dense::floats * count, to, non_temporal);
        } else {
            copy_between_gaps<L>(part, count, out, to);
        }
    };
    deform_units<L, squeeze, streams, false>(rest, k, first, vertices, out.peeled != 0 ? out.peeled : unit<L>,
                                             store);
}

}  // namespace goffer::bend
