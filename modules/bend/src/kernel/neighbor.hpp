// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <cstddef>

namespace goffer::bend {

/// Makes what `own` has of wrinkles that of the region beyond a joint, with amplitudes and squeezes as those
/// of the region itself, and touches nothing else of it: take(from, factor, to) sets a number to the
/// neighbor's times `factor`. K is Coefficients or LaneCoefficients. `relative`: the squeezes are. `take`
/// must be of the caller's own type, so that no instruction set has another's instance of this.
template <class K, class Take>
void take_as_own(const K& neighbor, const JointBlend& joint, bool relative, K& own, const Take& take) {
    for (std::size_t n = 0; n < amplitude_terms; ++n) {
        take(neighbor.amplitude[n], joint.gain[n], own.amplitude[n]);
        take(neighbor.amplitude_slope[n], joint.gain[n], own.amplitude_slope[n]);
    }
    take(neighbor.cos_half_direction, 1, own.cos_half_direction);
    take(neighbor.sin_half_direction, 1, own.sin_half_direction);
    if (!relative) return;
    take(neighbor.cos_direction, 1, own.cos_direction);
    take(neighbor.sin_direction, 1, own.sin_direction);
    take(neighbor.onset, 1, own.onset);
    take(neighbor.kappa_change, joint.radius_ratio, own.kappa_change);
    for (std::size_t n = 0; n < 2; ++n) {
        take(neighbor.rest_curl[n], joint.radius_ratio, own.rest_curl[n]);
        take(neighbor.curl_change[n], joint.radius_ratio, own.curl_change[n]);
    }
}

}  // namespace goffer::bend
