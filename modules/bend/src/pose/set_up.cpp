// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "kernel/kernels.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>

#include <algorithm>
#include <cassert>

namespace goffer::bend {
namespace {

/// Set-up leaves what the kernels of an instance do not read as it was.
void set_unread(Coefficients& k, Squeeze squeeze) noexcept {
    if (squeeze == Squeeze::none) {
        std::ranges::fill(k.amplitude, 0.0f);
        std::ranges::fill(k.amplitude_slope, 0.0f);
    }
    if (squeeze == Squeeze::relative) return;
    k.cos_direction = k.sin_direction = 0;
    std::ranges::fill(k.rest_curl, 0.0f);
    std::ranges::fill(k.curl_change, 0.0f);
    k.onset = k.kappa_change = 0;
}

void set_up(const Batch& batch, std::span<Coefficients> result, Isa isa, Time time) noexcept {
    assert(batch.body != nullptr && !batch.body->empty());
    const BodyData& body = *batch.body->data();
    const std::size_t regions = body.regions.size();
    assert(result.size() >= batch.count * regions);
    const Setup setup = kernels(isa).setup;
    const auto take = [&](PosedGroup& group, std::size_t first) {
        Coefficients* const k = &result[first * regions];
        for (std::size_t r = 0; r < regions; ++r) {
            group.set_up(r, setup, true, k + r, regions);
            for (std::size_t i = 0; i < group.count(); ++i) set_unread(k[i * regions + r], group.squeeze(i));
        }
    };
    each_group(batch, body, time, PosedGroup::capacity(regions), take);
}

}  // namespace

RestColumns rest_columns(const Body& body) noexcept {
    assert(!body.empty());
    return body.data()->columns;
}

NeighborShare neighbor_share(const Body& body, std::size_t region, float height) noexcept {
    assert(region < body.region_count());
    const auto& [below, above] = body.data()->details[region].joints;
    const auto share_of = [height](const Joint& joint, int neighbor) -> NeighborShare {
        const JointBlend& blend = joint.blend;
        const float x = std::min(blend.per_height * height + blend.at, 1.0f);
        return {neighbor, x * x * (1.5f - x), 3 * blend.per_length * (x - x * x), blend.gain[0],
                blend.radius_ratio};
    };
    if (below.nears(height)) return share_of(below, -1);
    if (above.nears(height)) return share_of(above, 1);
    return {};
}

void set_up(const Batch& batch, std::span<Coefficients> result, Isa isa) noexcept {
    set_up(batch, result, isa, Time::now);
}

void set_up_previous(const Batch& batch, std::span<Coefficients> result, Isa isa) noexcept {
    assert(!batch.previous_poses.empty());
    set_up(batch, result, isa, Time::before);
}

}  // namespace goffer::bend
