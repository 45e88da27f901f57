// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"
#include "pose/blending.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/sockets.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace goffer::bend {
namespace {

constexpr std::size_t chunk = 32;  // sockets deformed at a time, into planes on the stack

}  // namespace

void Sockets::frames(std::span<const Pose> poses, std::span<SocketFrame> frames,
                     const glm::mat4x3& transform) const noexcept {
    DeformJob job;
    job.poses = poses;
    job.transform = transform;
    this->frames(job, frames);
}

void Sockets::frames(const DeformJob& job, std::span<SocketFrame> frames) const noexcept {
    assert(!body_.empty() && poses_of(job).size() == body_.region_count() && frames.size() >= count());
    const BodyData& body = *body_.data();
    const KernelSet& set = kernels(job.isa);
    alignas(64) float planes[10][chunk + max_unit];
    const auto vector = [&](std::size_t plane, std::size_t i) {
        return glm::vec3(planes[plane][i], planes[plane + 1][i], planes[plane + 2][i]);
    };
    const PlaneOutput out = {{planes[0], planes[1], planes[2]},
                             {planes[3], planes[4], planes[5]},
                             {planes[6], planes[7], planes[8], planes[9]}};
    const PosedInstance posed(body, set.setup, poses_of(job), job.transform, job.wrinkle_weight);
    constexpr StreamSet streams = StreamSet::positions_normals_tangents;
    Blending blending;
    const auto deform = [&](std::size_t r, const Joint* joint, std::size_t first, std::size_t last) {
        for (; first < last; first += chunk) {
            const std::size_t count = std::min(chunk, last - first);
            const KernelInput input = joint == nullptr || posed.squeezes[r] == Squeeze::none
                                          ? KernelInput{&body.columns, &posed.k[r], posed.squeezes[r], first}
                                          : blending.blend(body, set, r, *joint, {posed.k, posed.squeezes},
                                                           streams, first, count, true);
            set.plane_kernel(input.squeeze, streams)(*input.columns, *input.k, out, 0, input.first, count,
                                                     Write::staged);
            for (std::size_t i = 0; i < count; ++i) {
                const glm::vec3 normal = vector(3, i), tangent = vector(6, i);
                frames[place_[first + i]] = {tangent, glm::cross(normal, tangent), normal, vector(0, i)};
            }
        }
    };
    for (std::size_t r = 0; r < body.regions.size(); ++r) {
        const Joint &below = body.details[r].joints.below, &above = body.details[r].joints.above;
        deform(r, &below, below.first, below.last);
        deform(r, nullptr, below.last, above.first);
        deform(r, &above, above.first, above.last);
    }
}

}  // namespace goffer::bend
