// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/bend_kernel.hpp"
#include "kernel/copy_kernel.hpp"
#include "kernel/setup_kernel.hpp"

namespace goffer::bend {

/// Which kernels an instruction set has beside those that write planes.
enum class RecordKernels : unsigned char {
    yes,
    /// Records are copied from the staging buffer, which takes up to a quarter longer: for instruction sets
    /// that few run, since these kernels are two thirds of the code.
    no,
};

template <class L, RecordKernels records, Squeeze squeeze, StreamSet streams>
constexpr void add_kernels(KernelSet& set) {
    set.planes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
        &bend_to_planes<L, squeeze, streams>;
    if constexpr (records == RecordKernels::no) return;
    if constexpr (squeeze != Squeeze::shaped)
        set.rows[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
            &bend_to_rows<L, squeeze, streams>;
    if constexpr (streams != StreamSet::positions_normals_tangents)
        set.weaving[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
            &bend_to_records<L, squeeze, streams>;
}

template <class L, RecordKernels records, Squeeze squeeze>
constexpr void add_kernels(KernelSet& set) {
    add_kernels<L, records, squeeze, StreamSet::positions>(set);
    add_kernels<L, records, squeeze, StreamSet::positions_normals>(set);
    add_kernels<L, records, squeeze, StreamSet::positions_normals_tangents>(set);
    add_kernels<L, records, squeeze, StreamSet::packed>(set);
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
    set.weave[3] = &weave<Single, 3>;
    set.weave[6] = &weave<Single, 6>;
    set.weave[7] = &weave<Single, 7>;
    set.weave[9] = &weave<Single, 9>;
    set.weave[10] = &weave<Single, 10>;
    set.weave[13] = &weave<Single, 13>;
    set.copy_lines = &copy_lines<Single>;
    set.setup = &set_up<Single>;
    return set;
}

}  // namespace goffer::bend
