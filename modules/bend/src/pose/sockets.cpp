// SPDX-License-Identifier: MIT
#include "pose/instance.hpp"
#include "kernel/kernels.hpp"
#include "job/run.hpp"

#include <goffer/bend/sockets.hpp>

#include <glm/geometric.hpp>

#include <algorithm>

namespace goffer::bend {
namespace {

constexpr std::size_t chunk = 32;  // sockets that are deformed at a time, on the stack

}  // namespace

void Sockets::frames(std::span<const Pose> poses, std::span<SocketFrame> frames,
                     const glm::mat4x3& transform) const noexcept {
    DeformJob job;
    job.poses = poses;
    job.transform = transform;
    this->frames(job, frames);
}

void Sockets::frames(const DeformJob& job, std::span<SocketFrame> frames) const noexcept {
    const Posed posed = {&body_, poses_of(job), &job.transform, job.wrinkles};
    const KernelSet& set = kernels(job.isa);
    alignas(64) float planes[9][chunk];
    const auto vector = [&](std::size_t plane, std::size_t i) {
        return glm::vec3(planes[plane][i], planes[plane + 1][i], planes[plane + 2][i]);
    };
    each_region(posed, [&](std::size_t r, const Coefficients& k) {
        const Region& region = body_.regions()[r];
        for (std::size_t first = region.first; first < region.last; first += chunk) {
            const std::size_t count = std::min(chunk, region.last - first);
            run_block(body_, k, set, first, count, planes[0], chunk);
            for (std::size_t i = 0; i < count; ++i) {
                const glm::vec3 normal = vector(3, i), tangent = vector(6, i);
                frames[place_[first + i]] = {vector(0, i),
                                             glm::mat3(tangent, glm::cross(normal, tangent), normal)};
            }
        }
    });
}

}  // namespace goffer::bend
