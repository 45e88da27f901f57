// SPDX-License-Identifier: MIT
#include "job/lane_runner.hpp"

#include "output/staging_buffer.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace goffer::bend {

static_assert(sizeof(LaneRunner) <= std::size_t{56} << 10, "crowd.hpp states how much stack a run takes");

/// The limits are measured, with AVX2 and AVX-512: what a call of a kernel, a joint and a half-filled
/// register cost has to outweigh what tiles and planes cost. A body of two regions without joints has too few
/// of the former.
bool LaneRunner::suits(const Batch& batch, std::size_t instances, const KernelSet& kernels) noexcept {
    constexpr std::size_t few_with_joints = 60, few = 25, min_regions = 3, min_together = setup_width / 2;
    if (kernels.lane_setup == nullptr || !batch.packed.empty() || !batch.bounds.empty()) return false;
    if (batch.positions.empty() && batch.normals.empty() && batch.tangents.empty()) return false;
    const BodyData& body = *batch.body->data();
    const std::size_t regions = body.regions.size();
    if (std::min(instances, PosedGroup::capacity(regions)) < min_together) return false;
    const bool joints = std::ranges::any_of(
        body.details, [](const RegionData& region) { return region.joints.above.blends(); });
    const bool twice = !batch.previous_positions.empty();
    if (joints) return body.vertex_count <= few_with_joints * regions && !(twice && batch.scratch_gaps);
    return regions >= min_regions && body.vertex_count <= few * regions && !twice;
}

LaneRunner::LaneRunner(const Batch& batch, const KernelSet& kernels, bool non_temporal,
                       bool wrinkled) noexcept
    : batch_(batch),
      body_(*batch.body->data()),
      kernels_(kernels),
      plan_(batch, kernels, non_temporal),
      pass_(plan_.passes()[0]),
      wrinkled_(wrinkled),
      values_(plan_.value_count()),
      posed_(body_, PosedGroup::capacity(body_.regions.size())) {
    assert(plan_.passes().size() == 1);
    // An odd number of lines per member, so that members do not compete for the same sets of the cache.
    const std::size_t lines = (max_lines - values_ * tile_vertices) / setup_width;
    stride_ = (lines - 1) / values_ * line_floats;
    member_floats_ = (values_ * stride_ / line_floats | 1) * line_floats;
}

void LaneRunner::add(std::size_t instance) noexcept {
    const std::size_t vertex = first_vertex_of(batch_, instance);
    const std::size_t element = element_of(batch_, instance);
    members_[posed_.count()] = {vertex, plan_.peeled(vertex), 0, 0};
    posed_.add(batch_, {&element, 1}, Time::now, result_);
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

/// Asks early for the first and the last line of a member where they are not written whole: they must be read
/// first.
void LaneRunner::prefetch_ends() const noexcept {
    for (const Record& record : plan_.records()) {
        const std::size_t step = record.stride_floats();
        for (std::size_t i = 0; i < posed_.count(); ++i) {
            const std::size_t vertex = members_[i].vertex, end = vertex + body_.vertex_count;
            if (record.to_line(vertex) != 0) kernels_.prefetch(record.first + vertex * step);
            if (record.to_line(end) != 0)
                kernels_.prefetch(record.first + (end - 1) * step + record.floats - 1);
        }
    }
}

void LaneRunner::set_up(std::size_t region) noexcept {
    squeezes_[region % kept] =
        posed_.set_up(region, kernels_.lane_setup, wrinkled_, pass_.streams != StreamSet::positions,
                      coefficients_[region % kept]);
}

/// Deforms the vertices of a region.
void LaneRunner::deform(std::size_t region) noexcept {
    const std::size_t first = region == 0 ? 0 : body_.regions[region - 1].last;
    const std::size_t last = body_.regions[region].last;
    const LaneCoefficients& k = coefficients_[region % kept];
    const Squeeze squeeze = squeezes_[region % kept];
    const LaneKernel bend = kernels_.lane_kernel(squeeze, pass_.streams);
    const auto bend_some = [&](std::size_t begin, std::size_t count, InstanceLanes* to) {
        bend(body_.columns, k, begin, count, to);
    };
    if (squeeze == Squeeze::none) return fill_tiles(first, last, bend_some);
    const LaneBlendKernel blend = kernels_.lane_blend_kernel(squeeze, pass_.streams);
    const auto blend_all = [&](const Joint& joint, std::size_t begin, std::size_t end) {
        if (begin >= end) return;
        const LaneCoefficients& neighbor = coefficients_[joint.neighbor % kept];
        fill_tiles(begin, end, [&](std::size_t from, std::size_t count, InstanceLanes* to) {
            blend(body_.columns, k, neighbor, joint.blend, from, count, to);
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

/// Appends the vertices of the tile to the planes of each member. Writes all tile_vertices, even if there are
/// fewer; less than a line waits before them.
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

/// Writes what is in the planes. Unless the instances end there, the beginnings of lines wait; a tile of them
/// is still to come, so that no write but the last one reaches the gap behind an instance.
void LaneRunner::write(bool ends) noexcept {
    const bool in_lines = plan_.non_temporal() && !ends;
    for (std::size_t i = 0; i < posed_.count(); ++i) {
        Member& member = members_[i];
        const std::size_t available = member.waiting + filled_;
        // Never less than a line, which peeled vertices are.
        const std::size_t waiting = in_lines ? (member.written + available - member.peeled) % line_floats : 0;
        const std::size_t count = available - waiting;
        StagedPlanes(plane(i, 0), stride_)
            .write(plan_, kernels_, pass_.mode, member.vertex + member.written, count, ends);
        member.written += count;
        member.waiting = waiting;
        if (waiting == 0) continue;
        for (std::size_t value = 0; value < values_; ++value) {
            float line[line_floats];  // a whole one takes fewer instructions than what waits
            std::memcpy(line, plane(i, value) + count, sizeof line);
            std::memcpy(plane(i, value), line, sizeof line);
        }
    }
    filled_ = 0;
}

}  // namespace goffer::bend
