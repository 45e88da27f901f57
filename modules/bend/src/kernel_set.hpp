// SPDX-License-Identifier: MIT
#pragma once

#include "kernel.hpp"

namespace goffer::bend {

/// All kernels over the lanes `L`.
template <class L>
constexpr KernelSet kernel_set() {
    using Single = typename L::Single;
    KernelSet set{};
    set.planes[1] = &bend_range<L, 1, Form::planes>;
    set.planes[2] = &bend_range<L, 2, Form::planes>;
    set.planes[3] = &bend_range<L, 3, Form::planes>;
    set.planes[4] = &bend_range<L, 4, Form::planes>;
    set.planes[5] = &bend_range<L, 5, Form::planes>;
    set.planes[6] = &bend_range<L, 6, Form::planes>;
    set.planes[7] = &bend_range<L, 7, Form::planes>;
    set.planes[packed_streams] = &bend_range<L, 3, Form::packed_planes>;
    set.records[1] = &bend_range<L, 1, Form::records>;
    set.records[3] = &bend_range<L, 3, Form::records>;
    set.records[packed_streams] = &bend_range<L, 3, Form::packed_records>;
    set.interleave[1] = &interleave<Single, 1>;
    set.interleave[3] = &interleave<Single, 3>;
    set.interleave[6] = &interleave<Single, 6>;
    set.interleave[7] = &interleave<Single, 7>;
    set.interleave[10] = &interleave<Single, 10>;
    return set;
}

}  // namespace goffer::bend
