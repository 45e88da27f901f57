// SPDX-License-Identifier: MIT
#include "pose/posed_group.hpp"

#include "kernel/direction.hpp"
#include "pose/matrix_layout.hpp"

#include <goffer/simd/scalar_lanes.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

/// The state of a pose. Inline, since a call for each instance takes time.
inline PoseState state_in(const Region& region, const Pose& pose) noexcept {
    const bool at_rest =
        !(pose.angle * 0.0f + pose.direction * 0.0f == 0);  // x * 0 is NaN if x is not finite
    return {.clamped = std::fabs(pose.angle) > region.max_angle && !at_rest, .at_rest = at_rest};
}

/// The state of `poses`; `regions` are those of the body.
inline PoseState state_in(const Region* regions, std::span<const Pose> poses) noexcept {
    PoseState state;
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const PoseState own = state_in(regions[r], poses[r]);
        state.clamped |= own.clamped;
        state.at_rest |= own.at_rest;
    }
    return {.clamped = state.clamped && !state.at_rest, .at_rest = state.at_rest};
}

/// Sets a vector, which a 0 follows, in all lanes.
void set_vector(float (*columns)[setup_width], const float (&vector)[4]) noexcept {
    for (std::size_t c = 0; c < 3; ++c) std::fill_n(columns[c], setup_width, vector[c]);
}

/// Copies a matrix into lane `i`, column after column. `from`: its first number.
void set_matrix(float (*columns)[setup_width], const float* from, MatrixSteps steps, std::size_t i) noexcept {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) columns[3 * c + r][i] = from[c * steps.column + r * steps.row];
    }
}

}  // namespace

PoseState state_of(const BodyData& body, std::span<const Pose> poses) noexcept {
    return state_in(body.regions.data(), poses);
}

PosedGroup::PosedGroup(const BodyData& body, std::size_t most) noexcept
    : body_(body), region_count_(body.regions.size()), most_(most) {
    assert(most >= 1 && most <= capacity(region_count_));
    // Set-up computes with unused lanes, too.
    const std::size_t read = (region_count_ - 1) * most + setup_width;
    for (float* values : {angle_, direction_, factor_}) std::fill_n(values, read, 0.0f);
    set_frames();
    set_identities();
}

/// Sets the frames of the first region, for all lanes.
void PosedGroup::set_frames() noexcept {
    const Frame frame = body_.base;  // a copy, of which nothing that is filled can be part
    for (std::size_t axis = 0; axis < 3; ++axis) set_vector(&columns_.frame[3 * axis], frame.axes[axis]);
    set_vector(&columns_.frame[9], frame.origin);
}

void PosedGroup::set_identities() noexcept {
    static constexpr float identity[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0}};
    for (std::size_t c = 0; c < 4; ++c) set_vector(&columns_.transform[3 * c], identity[c]);
    transformed_ = false;
}

inline void PosedGroup::set_pose(std::size_t region, std::size_t place, const Pose& pose,
                                 float weight) noexcept {
    const RegionData& details = body_.details[region];
    const bool wrinkled = details.setup.rows != nullptr && weight > 0;
    angle_[place] = pose.angle;
    direction_[place] = wrappable_direction(pose.direction);
    factor_[place] = weight;
    wrinkled_[place] = wrinkled;
    if (wrinkled && !details.factors->empty()) [[unlikely]]
        take_factor(region, place, pose);
}

/// Sets poses in lane `i`: those of regions beyond `poses` are their rest poses, and if a number is not
/// finite all are.
inline PoseState PosedGroup::set_poses(std::span<const Pose> poses, std::size_t i, float weight) noexcept {
    poses = poses.first(std::min(poses.size(), region_count_));
    const PoseState state = state_in(body_.regions.data(), poses);
    if (state.at_rest) poses = {};
    for (std::size_t r = 0; r < region_count_; ++r)
        set_pose(r, r * most_ + i, r < poses.size() ? poses[r] : body_.regions[r].rest, weight);
    return state;
}

void PosedGroup::add(std::span<const Pose> poses, const glm::mat4x3& transform, float weight) noexcept {
    if (count_ == 0 && region_count_ > 1) set_frames();  // set-up replaced them
    set_matrix(columns_.transform, &transform[0][0], steps_of(TransformColumn::MatrixLayout::columns3),
               count_);
    transformed_ = true;
    set_poses(poses, count_++, usable_weight(weight));
}

/// Takes poses in a loop without branches. Returns false if they have to be taken one by one: the body has
/// several regions or a factor table, or a pose is clamped or not finite, or turns more often than set-up
/// takes.
inline bool PosedGroup::take_usual_poses(const StridedView<Pose>& poses, const StridedView<float>& weights,
                                         std::span<const std::size_t> elements) noexcept {
    if (region_count_ > 1 || !body_.details[0].factors->empty()) return false;
    const float max_angle = body_.regions[0].max_angle;
    const bool wrinkles = body_.details[0].setup.rows != nullptr;
    bool usual = true;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const Pose& pose = poses[elements[i]];
        const float weight = weight_at(weights, elements[i]);
        const std::size_t place = count_ + i;
        angle_[place] = pose.angle;
        direction_[place] = pose.direction;
        factor_[place] = weight;
        wrinkled_[place] = wrinkles && weight > 0;
        usual &= std::fabs(pose.angle) <= max_angle;
        usual &= std::fabs(pose.direction) <= max_wrapped;
    }
    return usual;
}

/// Takes the matrices of the lanes that come next: the identity if there are none.
inline void PosedGroup::take_transforms(const TransformColumn& transforms,
                                        std::span<const std::size_t> elements) noexcept {
    if (transforms.empty()) {
        if (transformed_) set_identities();  // lanes hold matrices of another column
        return;
    }
    const MatrixSteps steps = steps_of(transforms.layout);
    for (std::size_t i = 0; i < elements.size(); ++i)
        set_matrix(columns_.transform, transforms.first.at(elements[i]), steps, count_ + i);
    transformed_ = true;
}

void PosedGroup::add(const Batch& batch, std::span<const std::size_t> elements, Time time,
                     CrowdResult& result) noexcept {
    assert(count_ + elements.size() <= most_);
    if (count_ == 0 && region_count_ > 1) set_frames();
    const bool now = time == Time::now;
    const StridedView<Pose>& poses = now ? batch.poses : batch.previous_poses;
    take_transforms(now ? batch.transforms : batch.previous_transforms, elements);
    if (take_usual_poses(poses, batch.wrinkle_weights, elements)) {
        result.deformed += elements.size();
        count_ += elements.size();
        return;
    }
    for (const std::size_t element : elements) {
        const float weight = weight_at(batch.wrinkle_weights, element);
        bend::count(set_poses({poses.at(element), region_count_}, count_++, weight), result);
    }
}

/// Multiplies the factor by that of the factor table.
void PosedGroup::take_factor(std::size_t region, std::size_t place, const Pose& pose) noexcept {
    const Region& limits = body_.regions[region];
    const FactorTable& factors = *body_.details[region].factors;
    const float direction = wrapped_direction<simd::ScalarLanes>(direction_[place]);
    const float turned = pose.angle < 0 ? std::numbers::pi_v<float> : 0.0f;
    factor_[place] *= factors.at(std::min(std::fabs(pose.angle), limits.max_angle),
                                 direction - limits.rest.direction + turned);
}

const RegionData& PosedGroup::take_region(std::size_t region) noexcept {
    const RegionData& details = body_.details[region];
    squeeze_ = details.squeeze;
    bare_ = details.setup.shaped ? Squeeze::shaped : Squeeze::none;
    place_ = region * most_;
    columns_.angle = angle_ + place_;
    columns_.direction = direction_ + place_;
    columns_.factor = factor_ + place_;
    return details;
}

Squeeze PosedGroup::set_up(std::size_t region, LaneSetup setup, bool wrinkled, bool normals,
                           LaneCoefficients& k) noexcept {
    const RegionData& details = take_region(region);
    wrinkled = wrinkled && details.setup.rows != nullptr;
    setup(details.setup, columns_, wrinkled, normals, k);
    return wrinkled ? squeeze_ : bare_;
}

void PosedGroup::set_up(std::size_t region, Setup setup, bool normals, Coefficients* k,
                        std::size_t step) noexcept {
    const RegionData& details = take_region(region);
    setup(details.setup, columns_, count_, wrinkled_ + place_, normals, k, step);
}

PosedInstance::PosedInstance(const BodyData& body, Setup setup, std::span<const Pose> poses,
                             const glm::mat4x3& transform, float weight) noexcept {
    PosedGroup group(body, 1);
    group.add(poses, transform, weight);
    for (std::size_t r = 0; r < body.regions.size(); ++r) {
        group.set_up(r, setup, true, &k[r], 1);
        squeezes[r] = group.squeeze(0);
    }
}

}  // namespace goffer::bend
