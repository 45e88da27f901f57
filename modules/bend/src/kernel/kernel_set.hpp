// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/kernel.hpp"

namespace goffer::bend {

template <class L, Squeeze squeeze>
constexpr void add_planes(Kernel (&planes)[squeeze_count][9]) {
    Kernel(&own)[9] = planes[static_cast<std::size_t>(squeeze)];
    own[1] = &bend_range<L, squeeze, 1, Form::planes>;
    own[3] = &bend_range<L, squeeze, 3, Form::planes>;
    own[7] = &bend_range<L, squeeze, 7, Form::planes>;
    own[packed_streams] = &bend_range<L, squeeze, 3, Form::packed_planes>;
}

/// All kernels over the lanes `L`.
template <class L>
constexpr KernelSet kernel_set() {
    using Single = typename L::Single;
    KernelSet set{};
    add_planes<L, Squeeze::none>(set.planes);
    add_planes<L, Squeeze::plain>(set.planes);
    add_planes<L, Squeeze::relative>(set.planes);
    set.records[1] = &bend_range<L, Squeeze::plain, 1, Form::records>;
    set.records[3] = &bend_range<L, Squeeze::plain, 3, Form::records>;
    set.records[packed_streams] = &bend_range<L, Squeeze::plain, 3, Form::packed_records>;
    set.interleave[1] = &interleave<Single, 1>;
    set.interleave[3] = &interleave<Single, 3>;
    set.interleave[6] = &interleave<Single, 6>;
    set.interleave[7] = &interleave<Single, 7>;
    set.interleave[10] = &interleave<Single, 10>;
    return set;
}

}  // namespace goffer::bend
