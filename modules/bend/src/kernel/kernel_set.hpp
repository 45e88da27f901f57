// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/bend_kernel.hpp"
#include "kernel/copy_kernel.hpp"
#include "kernel/setup_kernel.hpp"

namespace goffer::bend {

template <class L, Squeeze squeeze, StreamSet streams>
constexpr void add_kernels(KernelSet& set) {
    set.planes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
        &bend_to_planes<L, squeeze, streams>;
    if constexpr (squeeze != Squeeze::shaped)
        set.rows[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
            &bend_to_rows<L, squeeze, streams>;
    if constexpr (streams != StreamSet::positions_normals_tangents)
        set.weaving[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)] =
            &bend_to_records<L, squeeze, streams>;
}

template <class L, Squeeze squeeze>
constexpr void add_kernels(KernelSet& set) {
    add_kernels<L, squeeze, StreamSet::positions>(set);
    add_kernels<L, squeeze, StreamSet::positions_normals>(set);
    add_kernels<L, squeeze, StreamSet::positions_normals_tangents>(set);
    add_kernels<L, squeeze, StreamSet::packed>(set);
}

/// All kernels of an instruction set. Those that deform vertices use `L`, the others its single registers.
template <class L>
constexpr KernelSet kernel_set() {
    using Single = typename L::Single;
    KernelSet set{};
    add_kernels<L, Squeeze::none>(set);
    add_kernels<L, Squeeze::plain>(set);
    add_kernels<L, Squeeze::relative>(set);
    add_kernels<L, Squeeze::shaped>(set);
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
