// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::bend {

/// Sine and cosine of one angle per lane.
template <class L>
struct SinCos {
    typename L::Vec sine, cosine;
};

}  // namespace goffer::bend
