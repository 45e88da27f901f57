// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/deform_batch.hpp"
#include "kernel/lines.hpp"

#include <cstddef>

/// The kernels that deform batch after batch of vertices and write planes. `L` is ScalarLanes,
/// XsimdLanes<Arch>, Avx2Lanes, Avx512Lanes, or DoubledLanes of one of these.

namespace goffer::bend {

/// Vertices that a kernel deforms at a time: a cache line of each plane, or a batch if that is wider.
template <class L>
constexpr std::size_t unit = L::width > line_floats ? L::width : line_floats;

template <class L>
constexpr std::size_t batches = unit<L> / L::width;

/// Stores the first `count` values of a batch. If it is two registers of a line each, the first may be a
/// whole line.
template <class L>
void store_part(float* to, typename L::Vec value, std::size_t count, Write write) {
    using Single = typename L::Single;
    if constexpr (Single::width == line_floats && L::width > line_floats) {
        if (write == Write::non_temporal && count >= line_floats) {
            Single::stream(to, L::single(value, 0));
            return Single::store_first(to + line_floats, L::single(value, 1), count - line_floats);
        }
    }
    L::store_first(to, value, count);
}

/// Asks early for the first and the last line where they are not written whole: these must be read first.
template <class L>
void prefetch_ends(const float* first, std::size_t floats) {
    if (floats_to_line<L>(first) != 0) L::Single::prefetch(first);
    if (floats_to_line<L>(first + floats) != 0) L::Single::prefetch(first + floats - 1);
}

/// Stores a batch of a plane: all of it if `whole`, else the first `count` values.
template <class L>
void store_batch(float* to, typename L::Vec value, bool whole, std::size_t count, Write write) {
    if (!whole) [[unlikely]] {
        store_part<L>(to, value, count, write);
    } else if (write == Write::non_temporal) {
        L::stream(to, value);
    } else {
        L::store(to, value);
    }
}

/// Stores the batches of a unit. Completes each line before it begins the next one, since the processor has
/// few buffers for lines that go past the cache.
template <class L>
void store_planes(const Results<L> (&results)[batches<L>], Vector<L> Results<L>::*part, float* const* out,
                  std::size_t j, std::size_t count, Write write) {
    const bool whole = count == unit<L> || write == Write::staged;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t b = 0; b < batches<L>; ++b) {
            const std::size_t before = b * L::width;
            store_batch<L>(out[c] + j + before, (results[b].*part).component[c], whole,
                           count < before ? 0 : count - before, write);
        }
    }
}

template <class L>
void store_signs(const Results<L> (&results)[batches<L>], float* out, std::size_t j, std::size_t count,
                 Write write) {
    const bool whole = count == unit<L> || write == Write::staged;
    for (std::size_t b = 0; b < batches<L>; ++b) {
        const std::size_t before = b * L::width;
        store_batch<L>(out + j + before, results[b].tangent_sign, whole, count < before ? 0 : count - before,
                       write);
    }
}

/// Returns where the last whole unit ends that has one of `vertices` and fits `room`. The unit at j is
/// followed by the one at `next`.
template <class L>
std::size_t end_of_units(std::size_t j, std::size_t next, std::size_t vertices, std::size_t room) {
    if (next >= vertices) return j + unit<L>;
    const std::size_t more = (vertices - next + unit<L> - 1) / unit<L> * unit<L>;
    return next + (more < room - unit<L> ? more : room - unit<L>);
}

/// Whether kernels that write planes read their constants where they use them. With normals they have more of
/// them than registers, so that compilers would load them all before the loop and keep copies on the stack:
/// that takes up to 8 % longer with AVX-512 and 3 % with AVX2, where operations and loads repeat a number for
/// nothing. (Those that write records gain nothing.)
template <class L, StreamSet streams>
constexpr bool planes_reread = L::Single::width >= 8 && has_normals(streams);

/// Returns `k`, of which the compiler no longer knows what it has read.
template <class L>
const Coefficients& reread(const Coefficients& k) {
    const Coefficients* same = &k;
#ifdef __GNUC__
    asm volatile("" : "+r"(same));
#endif
    return *same;
}

/// Deforms units of vertices and hands each to store(results, j, count), where j counts from `first`. The
/// first unit has `next` vertices. `rereads`: coefficients are read again for each.
template <class L, Squeeze squeeze, StreamSet streams, bool rereads, class Store>
void deform_units(const RestColumns& rest, const Coefficients& coefficients, std::size_t first,
                  std::size_t vertices, std::size_t next, const Store& store) {
    constexpr bool looks_ahead = squeeze == Squeeze::relative && !has_normals(streams);
    [[maybe_unused]] ColumnBuffer<L> ahead;
    [[maybe_unused]] std::size_t turned_from = 0, turned = 0;
    for (std::size_t j = 0; j < vertices; j = next, next += unit<L>) {
        const Coefficients& k = rereads ? reread<L>(coefficients) : coefficients;
        if constexpr (looks_ahead) {
            if (j >= turned) {
                turned_from = j;
                turned = end_of_units<L>(j, next, vertices, ColumnBuffer<L>::vertices);
                fill_column_buffer<L, squeeze>(rest, k, first + turned_from, first + turned, ahead);
            }
        }
        Results<L> results[batches<L>];
        for (std::size_t b = 0; b < batches<L>; ++b) {
            const std::size_t at = j + b * L::width;
            Bent<L> bent;
            if constexpr (looks_ahead) {
                bent.rho_c = L::load(ahead.rho_c + (at - turned_from));
                bent.rho_s = L::load(ahead.rho_s + (at - turned_from));
            } else {
                bent = turn_batch<L, squeeze, has_normals(streams)>(rest, k, first + at);
            }
            results[b] = deform_batch<L, squeeze, streams>(rest, k, bent, first + at);
        }
        store(results, j, (next < vertices ? next : vertices) - j);
    }
}

// Flattened into one loop, so that constants stay in registers as far as these suffice. The copies of
// arguments tell the compiler that no store changes them; those that are read again would gain nothing.
template <class L, Squeeze squeeze, StreamSet streams>
GOFFER_FLATTENED void bend_to_planes(const RestColumns& columns, const Coefficients& coefficients,
                                     const PlaneOutput& output, std::size_t out_first, std::size_t first,
                                     std::size_t vertices, Write write) {
    // Known from here on, it lets the compiler load constants straight into all lanes, in front of the loop.
    if (vertices == 0) return;
    PlaneOutput out = {};
    for (std::size_t c = 0; c < 3; ++c) {
        out.position[c] = output.position[c] + out_first;
        if constexpr (has_normals(streams) && streams != StreamSet::packed)
            out.normal[c] = output.normal[c] + out_first;
    }
    if constexpr (has_tangents(streams)) {
        for (std::size_t c = 0; c < 4; ++c) out.tangent[c] = output.tangent[c] + out_first;
    }
    std::size_t peeled = 0;
    if (write == Write::non_temporal) {
        peeled = floats_to_line<L>(out.position[0]);
        for (std::size_t c = 0; c < 3; ++c) {
            prefetch_ends<L>(out.position[c], vertices);
            if constexpr (has_normals(streams) && streams != StreamSet::packed)
                prefetch_ends<L>(out.normal[c], vertices);
            if constexpr (has_tangents(streams)) prefetch_ends<L>(out.tangent[c], vertices);
        }
    }
    const RestColumns rest = columns;
    const auto store = [&](const Results<L>(&results)[batches<L>], std::size_t j, std::size_t count) {
        store_planes<L>(results, &Results<L>::position, out.position, j, count, write);
        if constexpr (has_normals(streams) && streams != StreamSet::packed)
            store_planes<L>(results, &Results<L>::normal, out.normal, j, count, write);
        if constexpr (has_tangents(streams)) {
            store_planes<L>(results, &Results<L>::tangent, out.tangent, j, count, write);
            store_signs<L>(results, out.tangent[3], j, count, write);
        }
    };
    const std::size_t next = peeled != 0 ? peeled : unit<L>;
    if constexpr (planes_reread<L, streams>) {
        deform_units<L, squeeze, streams, true>(rest, coefficients, first, vertices, next, store);
    } else {
        const Coefficients k = coefficients;
        deform_units<L, squeeze, streams, false>(rest, k, first, vertices, next, store);
    }
}

}  // namespace goffer::bend
