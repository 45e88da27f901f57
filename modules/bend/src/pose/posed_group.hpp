// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/pose.hpp>

#include <glm/mat4x3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

/// From poses to coefficients: the part of set-up that treats one instance at a time. The arithmetic, which
/// treats many, is in kernel/setup_kernel.hpp.

namespace goffer::bend {

/// What a run makes of an instance's poses.
struct PoseState {
    bool clamped = false;  ///< an angle is beyond its region's max_angle
    bool at_rest = false;  ///< a number is not finite; then nothing counts as clamped
};

/// Counts an instance that was deformed.
inline void count(const PoseState& state, CrowdResult& result) noexcept {
    ++result.deformed;
    result.clamped += state.clamped ? 1 : 0;
    result.at_rest += state.at_rest ? 1 : 0;
}

/// Takes a wrinkle weight of any bits to 0..1. One so small that its products might be subnormal is 0: see
/// tiny_angle in kernel/setup_kernel.hpp.
[[nodiscard]] inline float usable_weight(float weight) noexcept {
    constexpr float tiny = 1e-12f;
    return std::isgreaterequal(weight, tiny) ? std::min(weight, 1.0f) : 0.0f;  // NaN traps in no comparison
}

/// The weight at an element of a column, which may not be given.
[[nodiscard]] inline float weight_at(const StridedView<float>& weights, std::size_t element) noexcept {
    return weights.empty() ? 1.0f : usable_weight(weights[element]);
}

/// Whether the current or the previous poses and transforms of an instance are meant.
enum class Time : std::uint8_t { now, before };

/// Which element of its columns an instance of a batch reads.
[[nodiscard]] inline std::size_t element_of(const Batch& batch, std::size_t instance) noexcept {
    return batch.indices.empty() ? instance : batch.indices[instance];
}

/// The first vertex of the buffer that an instance of a batch is deformed to.
[[nodiscard]] inline std::size_t first_vertex_of(const Batch& batch, std::size_t instance) noexcept {
    return batch.vertex_offsets.empty() ? instance * batch.vertex_step
                                        : std::size_t{batch.vertex_offsets[element_of(batch, instance)]};
}

/// The state of `poses`, of which there are at most as many as regions.
[[nodiscard]] PoseState state_of(const BodyData& body, std::span<const Pose> poses) noexcept;

/// Some instances of one body. Poses may hold any bits. There may be fewer than regions: the others are at
/// rest. An instance with a pose that is not finite is at rest as a whole.
///
/// Instances are added one value at a time, and set up a register at a time. Processors read a register that
/// was written in parts only when all that was written before it is in memory, past the cache too: a
/// BatchRunner adds a group before it deforms the one before that.
class PosedGroup {
public:
    /// Has room for `most` instances, at most capacity().
    PosedGroup(const BodyData& body, std::size_t most) noexcept;

    /// The most instances that a group of a body with so many regions holds.
    [[nodiscard]] static std::size_t capacity(std::size_t regions) noexcept {
        return std::clamp<std::size_t>(max_poses / regions, 1, setup_width);
    }

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    void clear() noexcept { count_ = 0; }

    /// Adds an instance. Until clear(), either all have a transform or none has. `weight` may hold any bits.
    void add(std::span<const Pose> poses, const glm::mat4x3& transform, float weight) noexcept;

    /// Adds the instances of a batch that read `elements` of its columns, and counts them in `result`.
    void add(const Batch& batch, std::span<const std::size_t> elements, Time time,
             CrowdResult& result) noexcept;

    /// Sets up region `region` of all instances; call it for the regions in order, from 0. The coefficients
    /// of instance i go to k[i * step]. `normals`: as in Setup.
    void set_up(std::size_t region, Setup setup, bool normals, Coefficients* k, std::size_t step) noexcept;

    /// The same for kernels that deform several instances at a time, of which all wrinkle, or none does.
    /// Returns which kernels serve them.
    Squeeze set_up(std::size_t region, LaneSetup setup, bool wrinkled, bool normals,
                   LaneCoefficients& k) noexcept;

    /// Which kernels serve instance i in the region that was set up last.
    [[nodiscard]] Squeeze squeeze(std::size_t i) const noexcept {
        return wrinkled_[place_ + i] ? squeeze_ : bare_;
    }

private:
    [[nodiscard]] bool take_usual_poses(const StridedView<Pose>& poses, const StridedView<float>& weights,
                                        std::span<const std::size_t> elements) noexcept;
    void take_transforms(const TransformColumn& transforms, std::span<const std::size_t> elements) noexcept;
    const RegionData& take_region(std::size_t region) noexcept;
    void set_identities() noexcept;
    void set_frames() noexcept;
    void set_pose(std::size_t region, std::size_t place, const Pose& pose, float weight) noexcept;
    PoseState set_poses(std::span<const Pose> poses, std::size_t i, float weight) noexcept;
    void take_factor(std::size_t region, std::size_t place, const Pose& pose) noexcept;

    static constexpr std::size_t max_poses = 160;  // as much stack as BatchRunner has left
    static_assert(max_poses >= max_regions);
    static constexpr std::size_t places = max_poses + setup_width;  // set-up reads whole registers

    const BodyData& body_;
    std::size_t region_count_;  // of the body; kept, since a vector has to compute its size
    std::size_t most_;
    std::size_t count_ = 0;
    std::size_t place_ = 0;                                   // of the region that was set up last, as are
    Squeeze squeeze_ = Squeeze::none, bare_ = Squeeze::none;  // these
    bool transformed_ = false;                                // lanes hold matrices other than the identity
    // Instance i in region r is at r * most_ + i.
    bool wrinkled_[places];
    alignas(64) float angle_[places];
    alignas(64) float direction_[places];
    alignas(64) float factor_[places];
    SetupColumns columns_;
};

/// One instance, set up: 9 KB.
struct PosedInstance {
    Coefficients k[max_regions];  ///< one per region
    Squeeze squeezes[max_regions];

    PosedInstance(const BodyData& body, Setup setup, std::span<const Pose> poses,
                  const glm::mat4x3& transform, float weight) noexcept;
};

/// Calls visit(group, first) for all instances of a batch, up to `most` <= PosedGroup::capacity() at a time:
/// those from `first` on.
template <class Visit>
void each_group(const Batch& batch, const BodyData& body, Time time, std::size_t most,
                const Visit& visit) noexcept {
    PosedGroup group(body, most);
    CrowdResult ignored;
    for (std::size_t first = 0; first < batch.count; first += most) {
        std::size_t elements[setup_width];
        const std::size_t count = std::min(most, batch.count - first);
        for (std::size_t i = 0; i < count; ++i) elements[i] = element_of(batch, first + i);
        group.clear();
        group.add(batch, {elements, count}, time, ignored);
        visit(group, first);
    }
}

/// The poses of a job: its span, or the single pose.
[[nodiscard]] inline std::span<const Pose> poses_of(const DeformJob& job) noexcept {
    return job.poses.empty() ? std::span<const Pose>(&job.pose, 1) : job.poses;
}

[[nodiscard]] inline std::span<const Pose> previous_poses_of(const DeformJob& job) noexcept {
    return job.previous_poses.empty() ? std::span<const Pose>(&job.previous_pose, 1) : job.previous_poses;
}

}  // namespace goffer::bend
