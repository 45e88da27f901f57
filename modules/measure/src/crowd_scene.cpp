// SPDX-License-Identifier: MIT
#include <goffer/measure/crowd_scene.hpp>

#include <algorithm>
#include <cstring>

namespace goffer::measure {
namespace {

std::size_t pose_count(const std::vector<CrowdGroup>& groups) noexcept {
    std::size_t poses = 0;
    for (const CrowdGroup& group : groups) poses += group.count * group.body->region_count();
    return poses;
}

/// `first` and what follows it, of instances with `regions` poses each.
StridedView<bend::Pose> by_instance(const bend::Pose* first, std::size_t count, std::size_t regions) {
    return {
        .data = first, .count = count, .stride = static_cast<std::uint32_t>(regions * sizeof(bend::Pose))};
}

/// FNV-1a by words of eight bytes; the shift lets high bits reach low ones, which bytes do by themselves.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
    constexpr std::uint64_t prime = 0x100000001b3;
    hash = (hash ^ word) * prime;
    return hash ^ (hash >> 32);
}

std::uint64_t mixed(std::uint64_t hash, std::span<const float> values) noexcept {
    constexpr std::size_t floats = sizeof(std::uint64_t) / sizeof(float);
    for (std::size_t i = 0; i < values.size(); i += floats) {
        std::uint64_t word = 0;
        std::memcpy(&word, &values[i], std::min(floats, values.size() - i) * sizeof(float));
        hash = mixed(hash, word);
    }
    return hash;
}

}  // namespace

std::size_t vertex_count(const std::vector<CrowdGroup>& groups) noexcept {
    std::size_t vertices = 0;
    for (const CrowdGroup& group : groups) vertices += group.count * group.vertex_step;
    return vertices;
}

CrowdScene::CrowdScene(const std::vector<CrowdGroup>& groups, const StreamLayout& layout,
                       std::span<float> memory)
    : layout_(layout),
      memory_(memory),
      vertices_(vertex_count(groups)),
      poses_(pose_count(groups)),
      previous_poses_(layout.previous ? poses_.size() : 0) {
    std::size_t pose = 0, vertex = 0;
    for (const CrowdGroup& group : groups) {
        const std::size_t regions = group.body->region_count(), own = group.count * group.vertex_step;
        bend::Batch& batch = batches_.emplace_back();
        batch.body = group.body;
        batch.count = group.count;
        batch.vertex_step = group.vertex_step;
        batch.poses = by_instance(poses_.data() + pose, group.count, regions);
        if (layout.previous)
            batch.previous_poses = by_instance(previous_poses_.data() + pose, group.count, regions);
        set_streams(batch, layout, memory, vertex, own);
        pose += group.count * regions;
        vertex += own;
    }
}

bend::DeformJob CrowdScene::instance(std::size_t index) const noexcept {
    auto batch = batches_.begin();
    std::size_t first = 0;
    for (; index >= batch->count; index -= batch->count, ++batch) first += batch->count * batch->vertex_step;
    const std::size_t regions = batch->body->region_count();
    bend::DeformJob job{.body = batch->body};
    job.poses = {batch->poses.at(index), regions};
    if (layout_.previous) job.previous_poses = {batch->previous_poses.at(index), regions};
    if (!batch->wrinkle_weights.empty()) job.wrinkle_weight = batch->wrinkle_weights[index];
    if (!batch->transforms.empty()) job.transform = batch->transforms[index];
    set_streams(job, layout_, memory_, first + index * batch->vertex_step, batch->body->vertex_count());
    return job;
}

std::uint64_t CrowdScene::hash() const noexcept {
    const std::size_t planes = layout_.record == 0 ? layout_.floats : 1;
    const std::size_t apart = memory_.size() / planes;
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::size_t plane = 0; plane < planes; ++plane)
        hash = mixed(hash, memory_.subspan(plane * apart, vertices_ * layout_.footprint() / planes));
    return hash;
}

}  // namespace goffer::measure
