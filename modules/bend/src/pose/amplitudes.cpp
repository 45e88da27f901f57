// SPDX-License-Identifier: MIT
#include "pose/center_line.hpp"

namespace goffer::bend {

Float4 amplitudes(const BodyData& body, std::size_t r, const Coefficients* k,
                  const Squeeze* squeezes) noexcept {
    const RegionData& region = body.details[r];
    const Float4 own = amplitudes(k[r], squeezes[r], region.bands.max_scale);
    float beyond = 0;
    for (const Joint* joint : {&region.joints.below, &region.joints.above}) {
        const Squeeze squeeze = squeezes[joint->neighbor];
        if (joint->first == joint->last || squeeze == Squeeze::none) continue;
        Coefficients other;
        set_as_own(k[joint->neighbor], joint->blend, squeeze == Squeeze::relative, other);
        beyond = std::max(beyond, amplitudes(other, squeeze, joint->max_scale)[sectors - 1]);
    }
    return simd::max(own, splat(0.5f) * (own + splat(beyond)));
}

}  // namespace goffer::bend
