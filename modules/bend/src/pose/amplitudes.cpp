// SPDX-License-Identifier: MIT
#include "pose/center_line.hpp"

#include <algorithm>
#include <cmath>

namespace goffer::bend {
namespace {

/// The most by which the scale of a column near a joint is larger in the neighbor at rest than in the region.
float max_rest_ratio(const JointBlend& joint, const Coefficients& k, float max_scale) noexcept {
    const auto size = [](const float(&curl)[2]) { return std::sqrt(curl[0] * curl[0] + curl[1] * curl[1]); };
    const float more = joint.rest_kappa + size(joint.rest_curl);
    if (!(more > 0)) return 1;
    const float scale = 1 - 2 * max_scale * size(k.rest_curl);  // kappa_0 is as large as rest_curl
    return 1 + max_scale * more / scale;
}

}  // namespace

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
        const float amplitude = amplitudes(other, squeeze, joint->max_scale)[sectors - 1];
        beyond = std::max(beyond, amplitude * max_rest_ratio(joint->blend, k[r], joint->max_scale));
    }
    return simd::max(own, splat(0.5f) * (own + splat(beyond)));
}

}  // namespace goffer::bend
