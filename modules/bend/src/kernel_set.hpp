// SPDX-License-Identifier: MIT
#pragma once

#include "interleave.hpp"
#include "kernel.hpp"

namespace goffer::bend {

/// All kernels of one instruction set: `L` deforms, `Narrow` (one register) interleaves.
template <class L, class Narrow = L>
constexpr KernelSet kernel_set() {
    KernelSet set{};
    set.by_streams[1] = &bend_range<L, 1>;
    set.by_streams[2] = &bend_range<L, 2>;
    set.by_streams[3] = &bend_range<L, 3>;
    set.by_streams[4] = &bend_range<L, 4>;
    set.by_streams[5] = &bend_range<L, 5>;
    set.by_streams[6] = &bend_range<L, 6>;
    set.by_streams[7] = &bend_range<L, 7>;
    set.packed = &bend_range<L, 3, true>;
    set.interleave[3] = &interleave<Narrow, 3>;
    set.interleave[6] = &interleave<Narrow, 6>;
    set.interleave[7] = &interleave<Narrow, 7>;
    set.interleave[10] = &interleave<Narrow, 10>;
    return set;
}

}  // namespace goffer::bend
