// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>
#include <goffer/measure/stream_layout.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace goffer::measure {

/// Instances of one body, whose vertices lie one instance behind the other.
struct CrowdGroup {
    const bend::Body* body = nullptr;  ///< must outlive the scene
    std::size_t count = 0;             ///< instances
    std::size_t vertex_step = 0;       ///< from one instance to the next: the body's vertices, or more
};

/// Vertices of all `groups`, with those between instances.
[[nodiscard]] std::size_t vertex_count(const std::vector<CrowdGroup>& groups) noexcept;

/// A crowd to be deformed frame after frame: bodies, the poses of their instances, the caller's memory, and
/// the batches that put these together, one for each group. Instances are counted from group to group.
/// Move-only; for one thread at a time.
class CrowdScene {
public:
    /// `memory` has layout.memory_floats(vertex_count(groups)) floats, no more, and outlives the scene, as
    /// what batches() are given later does.
    CrowdScene(const std::vector<CrowdGroup>& groups, const StreamLayout& layout, std::span<float> memory);
    CrowdScene(CrowdScene&&) = default;
    CrowdScene& operator=(CrowdScene&&) = default;

    /// Calls pose(index, poses) for every instance, to set its poses, one per region of its body. What they
    /// were are then the previous ones. Does not allocate.
    template <class PoseInstance>
    void set_poses(const PoseInstance& pose) {
        if (layout_.previous) previous_poses_ = poses_;
        std::size_t index = 0;
        std::span<bend::Pose> left = poses_;
        for (const bend::Batch& batch : batches_) {
            const std::size_t regions = batch.body->region_count();
            for (std::size_t i = 0; i < batch.count; ++i, left = left.subspan(regions))
                pose(index++, left.first(regions));
        }
    }

    /// All instances. Other columns than poses may be added to the batches.
    [[nodiscard]] std::span<bend::Batch> batches() noexcept { return batches_; }
    [[nodiscard]] bend::CrowdJob job(Isa isa = Isa::automatic,
                                     bend::Stores stores = bend::Stores::automatic) const noexcept {
        return {.batches = batches_, .stores = stores, .isa = isa};
    }
    /// Instance `index` as a job: the same inputs, and the same places for outputs.
    [[nodiscard]] bend::DeformJob instance(std::size_t index) const noexcept;

    [[nodiscard]] std::size_t vertices() const noexcept { return vertices_; }
    /// Bytes of the streams that a frame writes, without gaps, where instances have no vertices between them.
    [[nodiscard]] std::size_t bytes() const noexcept { return vertices_ * layout_.floats * sizeof(float); }
    /// 64 bits of all vertices, plane after plane or record after record.
    [[nodiscard]] std::uint64_t hash() const noexcept;

private:
    StreamLayout layout_;
    std::span<float> memory_;
    std::size_t vertices_;
    std::vector<bend::Pose> poses_, previous_poses_;  // of one instance after the other
    std::vector<bend::Batch> batches_;
};

}  // namespace goffer::measure
