// SPDX-License-Identifier: MIT
#include "pose/center_line.hpp"

namespace goffer::bend {
namespace {

/// The largest amplitude of all columns that the region beyond a joint has, as one of the region itself.
float amplitude_beyond(const JointBlend& joint, const Coefficients& neighbor, Squeeze squeeze,
                       float max_scale) noexcept {
    if (squeeze == Squeeze::none) return 0;
    Coefficients k = neighbor;
    for (std::size_t n = 0; n < amplitude_terms; ++n) k.amplitude[n] *= joint.gain[n];
    if (squeeze == Squeeze::relative) {
        k.kappa_change *= joint.squeeze;
        for (float& change : k.curl_change) change *= joint.squeeze;
    }
    return amplitudes(k, squeeze, max_scale)[sectors - 1];
}

}  // namespace

Float4 amplitudes(const BodyData& body, std::size_t r, const Coefficients* k,
                  const Squeeze* squeezes) noexcept {
    const RegionData& region = body.details[r];
    const float max_scale = region.bands.max_scale;
    const Float4 own = amplitudes(k[r], squeezes[r], max_scale);
    float beyond = 0;
    for (const Joint* joint : {&region.below, &region.above}) {
        const std::size_t n = joint->neighbor;
        if (joint->first != joint->last)
            beyond = std::max(beyond, amplitude_beyond(joint->blend, k[n], squeezes[n], max_scale));
    }
    return simd::max(own, splat(0.5f) * (own + splat(beyond)));
}

}  // namespace goffer::bend
