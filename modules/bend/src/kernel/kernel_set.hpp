// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/bend_kernel.hpp"
#include "kernel/blend_kernel.hpp"
#include "kernel/copy_kernel.hpp"
#include "kernel/lane_kernel.hpp"
#include "kernel/pair_kernel.hpp"
#include "kernel/record_kernel.hpp"
#include "kernel/rows_kernel.hpp"
#include "kernel/setup_kernel.hpp"
#include "kernel/shared_line_kernel.hpp"

#include <cstddef>
#include <utility>

namespace goffer::bend {

/// Which kernels an instruction set has beside those that write planes.
enum class RecordKernels : unsigned char {
    yes,
    /// Records are woven from the staging buffer, which takes up to a quarter longer: for instruction sets
    /// that few run, since the kernels that write records are half of the code.
    no,
};

template <class L, RecordKernels records, Squeeze squeeze, StreamSet streams>
constexpr void add_kernels(KernelSet& set) {
    set.planes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
        &bend_to_planes<L, squeeze, streams>;
    if constexpr (records == RecordKernels::yes && streams != StreamSet::positions_normals_tangents)
        set.weaving[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
            &bend_to_records<L, squeeze, streams>;
}

template <class L, RecordKernels records, Squeeze squeeze>
constexpr void add_kernels(KernelSet& set) {
    add_kernels<L, records, squeeze, StreamSet::positions>(set);
    add_kernels<L, records, squeeze, StreamSet::positions_normals>(set);
    add_kernels<L, records, squeeze, StreamSet::positions_normals_tangents>(set);
    add_kernels<L, records, squeeze, StreamSet::packed>(set);
    if constexpr (squeeze != Squeeze::none) {
        BlendKernel(&blending)[2] = set.blending[static_cast<unsigned char>(squeeze)];
        using Single = typename L::Single;
        blending[0] = &blend_wrinkles<Single, squeeze, false>;
        blending[1] = &blend_wrinkles<Single, squeeze, true>;
    }
}

template <class L, int... n>
constexpr void add_row_writers(KernelSet& set, std::integer_sequence<int, n...>) {
    ((set.write_rows[n] = &write_rows<L, n>), ...);
}

template <class L, std::size_t... n>
constexpr void add_weaves(KernelSet& set, std::index_sequence<n...>) {
    ((set.weave[n + min_woven] = &weave<L, static_cast<int>(n + min_woven)>), ...);
}

template <class L, Squeeze squeeze, StreamSet streams>
constexpr void add_lanes(KernelSet& set) {
    constexpr auto row = static_cast<unsigned char>(squeeze), column = static_cast<unsigned char>(streams);
    set.lanes[row][column] = &bend_lanes<L, squeeze, streams>;
    if constexpr (squeeze != Squeeze::none)
        set.lane_blending[row][column] = &bend_blended_lanes<L, squeeze, streams>;
}

template <class L, Squeeze squeeze>
constexpr void add_lanes(KernelSet& set) {
    add_lanes<L, squeeze, StreamSet::positions>(set);
    add_lanes<L, squeeze, StreamSet::positions_normals>(set);
    add_lanes<L, squeeze, StreamSet::positions_normals_tangents>(set);
}

/// Lines that two instances share are written by kernels of their own where a line is one register. Where it
/// is two, nothing is gained.
template <class L, Squeeze squeeze>
constexpr void add_shared_lines(KernelSet& set) {
    if constexpr (L::width == line_floats) {
        SharedLineKernel(&kernels)[2] = set.shared_lines[static_cast<unsigned char>(squeeze)];
        kernels[0] = &bend_shared_line<L, squeeze, StreamSet::positions>;
        kernels[1] = &bend_shared_line<L, squeeze, StreamSet::positions_normals>;
    }
}

template <class L, Squeeze squeeze>
constexpr void add_small_bodies(KernelSet& set) {
    add_lanes<L, squeeze>(set);
    add_shared_lines<L, squeeze>(set);
}

/// Adds the kernels for many small bodies, if these are wanted: those that deform many instances at a time,
/// and those for lines that two share. `L` has at most setup_width lanes.
template <class L>
constexpr KernelSet with_small_bodies(KernelSet set) {
#ifdef GOFFER_SMALL_BODIES
    add_small_bodies<L, Squeeze::none>(set);
    add_small_bodies<L, Squeeze::plain>(set);
    add_small_bodies<L, Squeeze::relative>(set);
    add_small_bodies<L, Squeeze::shaped>(set);
    set.lane_setup = &set_up_lanes<L>;
    set.untile = &untile<L>;
    set.prefetch = &L::prefetch;
#endif
    return set;
}

template <class L, Squeeze squeeze>
constexpr void add_pairs(KernelSet& set) {
    PairKernel(&pairs)[2] = set.pairs[static_cast<unsigned char>(squeeze)];
    pairs[0] = &bend_to_pairs<typename L::Single, squeeze, false>;
    pairs[1] = &bend_to_pairs<L, squeeze, true>;
}

/// Adds the kernels that deform to two poses at a time. They need many registers: with AVX2 they take as long
/// as the way through the staging buffer, or longer.
template <class L>
constexpr KernelSet with_pairs(KernelSet set) {
    add_pairs<L, Squeeze::none>(set);
    add_pairs<L, Squeeze::plain>(set);
    add_pairs<L, Squeeze::relative>(set);
    add_pairs<L, Squeeze::shaped>(set);
    return set;
}

/// All kernels of an instruction set. Those that deform vertices use `L`, the others its single registers.
template <class L, RecordKernels records = RecordKernels::yes>
constexpr KernelSet kernel_set() {
    using Single = typename L::Single;
    KernelSet set{};
    add_kernels<L, records, Squeeze::none>(set);
    add_kernels<L, records, Squeeze::plain>(set);
    add_kernels<L, records, Squeeze::relative>(set);
    add_kernels<L, records, Squeeze::shaped>(set);
    add_weaves<Single>(set, std::make_index_sequence<max_woven - min_woven + 1>());
    set.copy_lines = &copy_lines<Single>;
    add_row_writers<Single>(set, std::integer_sequence<int, 3, 4, 6>());
    set.setup = &set_up<Single>;
    return set;
}

}  // namespace goffer::bend
