// SPDX-License-Identifier: MIT
#include "job/lane_runner.hpp"

#include "output/staging_buffer.hpp"

#include <algorithm>
#include <cstring>

namespace goffer::bend {

static_assert(sizeof(LaneRunner) <= std::size_t{56} << 10, "crowd.hpp states how much stack a run takes");

/// Measured with AVX2 and AVX-512. What a region costs beside its vertices has to outweigh the way through
/// tiles and planes, which takes as long for every vertex as half of a kernel.
bool LaneRunner::suits(const Batch& batch, const KernelSet& kernels) noexcept {
    constexpr std::size_t few_with_joints = 60, few = 25, min_regions = 3, min_instances = setup_width / 2;
    const bool possible = kernels.lane_setup != nullptr && batch.packed.empty() && batch.bounds.empty() &&
                          batch.previous_positions.empty();
    if (!possible || batch.count < min_instances) return false;
    const BodyData& body = *batch.body->data();
    const std::size_t regions = body.regions.size();
    const bool joints = std::ranges::any_of(
        body.details, [](const RegionData& region) { return region.joints.above.blends(); });
    return joints ? body.vertex_count <= few_with_joints * regions
                  : regions >= min_regions && body.vertex_count <= few * regions;
}

LaneRunner::LaneRunner(const Batch& batch, const KernelSet& kernels, bool non_temporal,
                       bool wrinkled) noexcept
    : batch_(batch),
      body_(*batch.body->data()),
      kernels_(kernels),
      plan_(batch, kernels, non_temporal),
      wrinkled_(wrinkled),
      streams_(plan_.passes()[0].streams),
      values_(plan_.value_count()),
      posed_(body_, kernels.setup, PosedGroup::capacity(body_.regions.size())) {
    // An odd number of lines per member, so that members do not compete for the same sets of the cache.
    const std::size_t lines = (max_lines - values_ * tile_vertices) / setup_width;
    stride_ = (lines - 1) / values_ * line_floats;
    member_floats_ = (values_ * stride_ / line_floats | 1) * line_floats;
}

void LaneRunner::add(std::size_t instance) noexcept {
    const std::size_t element = element_of(batch_, instance);
    const std::size_t vertex = batch_.vertex_offsets.empty() ? instance * batch_.vertex_step
                                                             : std::size_t{batch_.vertex_offsets[element]};
    members_[posed_.count()] = {vertex, plan_.peeled(vertex), 0, 0};
    const PoseState state = posed_.add(batch_, element, Time::now);
    ++result_.deformed;
    result_.clamped += state.clamped ? 1 : 0;
    result_.at_rest += state.at_rest ? 1 : 0;
    if (posed_.count() == PosedGroup::capacity(body_.regions.size())) finish();
}

void LaneRunner::finish() noexcept {
    if (posed_.count() == 0) return;
    if (plan_.non_temporal()) prefetch_ends();
    set_up(0);
    for (std::size_t r = 0; r < body_.regions.size(); ++r) {
        if (r + 1 < body_.regions.size()) set_up(r + 1);
        deform(r);
    }
    if (in_tile_ != 0) take_tile_apart();
    write(true);
    posed_.clear();
}

/// Asks early for the lines that members do not write whole: they must be read first.
void LaneRunner::prefetch_ends() const noexcept {
    for (const Record& record : plan_.records()) {
        const std::size_t step = record.stride_floats();
        for (std::size_t i = 0; i < posed_.count(); ++i) {
            const float* const first = record.first + members_[i].vertex * step;
            kernels_.prefetch(first);
            kernels_.prefetch(first + body_.vertex_count * step - 1);
        }
    }
}

void LaneRunner::set_up(std::size_t region) noexcept {
    squeezes_[region % kept] =
        posed_.set_up(region, kernels_.lane_setup, wrinkled_, coefficients_[region % kept]);
}

/// Deforms the vertices of a region.
void LaneRunner::deform(std::size_t region) noexcept {
    const std::size_t first = region == 0 ? 0 : body_.regions[region - 1].last;
    const std::size_t last = body_.regions[region].last;
    const LaneCoefficients& k = coefficients_[region % kept];
    const Squeeze squeeze = squeezes_[region % kept];
    const LaneKernel bend = kernels_.lane_kernel(squeeze, streams_);
    const auto bend_some = [&](std::size_t begin, std::size_t count, InstanceLanes* to) {
        bend(body_.columns, k, begin, count, to);
    };
    if (squeeze == Squeeze::none) return fill_tiles(first, last, bend_some);
    const LaneBlendKernel blend = kernels_.lane_blend_kernel(squeeze, streams_);
    const auto blend_all = [&](const Joint& joint, std::size_t begin, std::size_t end) {
        if (begin >= end) return;
        set_as_own(coefficients_[joint.neighbor % kept], joint.blend, squeeze == Squeeze::relative,
                   neighbor_);
        fill_tiles(begin, end, [&](std::size_t from, std::size_t count, InstanceLanes* to) {
            blend(body_.columns, k, neighbor_, joint.blend, from, count, to);
        });
    };
    const auto& [below, above] = body_.details[region].joints;
    const std::size_t below_end = std::max(first, below.last);
    const std::size_t above_begin = std::clamp(above.first, below_end, last);
    blend_all(below, first, below_end);
    fill_tiles(below_end, above_begin, bend_some);
    blend_all(above, above_begin, last);
}

/// Calls kernel(begin, count, to) until all of [first, last) went through tiles.
template <class Kernel>
void LaneRunner::fill_tiles(std::size_t first, std::size_t last, const Kernel& kernel) noexcept {
    while (first < last) {
        const std::size_t count = std::min(last - first, tile_vertices - in_tile_);
        kernel(first, count, tile() + in_tile_);
        in_tile_ += count;
        first += count;
        if (in_tile_ == tile_vertices) take_tile_apart();
    }
}

/// Appends the vertices of the tile to the planes of each member. A tile that is not full fills its room,
/// too.
void LaneRunner::take_tile_apart() noexcept {
    if (filled_ + line_floats + tile_vertices > stride_) write(false);
    for (std::size_t value = 0; value < values_; ++value) {
        float* to[setup_width];
        for (std::size_t i = 0; i < setup_width; ++i)
            to[i] = plane(i, value) + filled_ + (i < posed_.count() ? members_[i].waiting : 0);
        kernels_.untile(tile() + value * tile_vertices, to);
    }
    filled_ += in_tile_;
    in_tile_ = 0;
}

/// Writes what is in the planes, but for the beginnings of lines unless it `ends` there.
void LaneRunner::write(bool ends) noexcept {
    alignas(64) static constexpr float zeros[max_lines / 3] = {};
    for (std::size_t i = 0; i < posed_.count(); ++i) {
        Member& member = members_[i];
        const std::size_t count = writable(member, ends);
        if (count != 0) {
            const StagedPlanes planes(plane(i, 0), stride_, zeros);
            planes.write(plan_, kernels_, member.vertex + member.written, count, ends);
        }
        member.written += count;
        member.waiting = member.waiting + filled_ - count;
        for (std::size_t value = 0; value < values_ && !ends && count != 0; ++value)
            std::memmove(plane(i, value), plane(i, value) + count, member.waiting * sizeof(float));
    }
    filled_ = 0;
}

/// How many of the vertices in a member's planes can be written.
std::size_t LaneRunner::writable(const Member& member, bool ends) const noexcept {
    const std::size_t available = member.waiting + filled_, end = member.written + available;
    if (ends || !plan_.non_temporal()) return available;
    if (end < member.peeled + line_floats) return 0;
    return available - (end - member.peeled) % line_floats;
}

}  // namespace goffer::bend
