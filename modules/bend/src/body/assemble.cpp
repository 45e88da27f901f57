// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "body/direction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace goffer::bend {
namespace {

Frame frame_of(const glm::dvec3& origin, const glm::dmat3& axes) {
    Frame frame = {};
    for (int row = 0; row < 3; ++row) {
        for (int c = 0; c < 3; ++c) frame.axes[c][row] = static_cast<float>(axes[c][row]);
        frame.origin[row] = static_cast<float>(origin[row]);
    }
    return frame;
}

Region region_of(const RegionInput& input, std::size_t first) {
    return {first,
            first + input.vertex_count,
            static_cast<float>(input.length),
            static_cast<float>(input.max_angle),
            static_cast<float>(input.onset),
            {static_cast<float>(input.rest_angle), static_cast<float>(input.rest_direction)}};
}

/// `shape`: the body has one.
Squeeze squeeze_of(const RegionInput& region, bool shape) {
    const Squeeze straight = shape ? Squeeze::shaped : Squeeze::plain;
    if (region.table.empty()) return shape ? Squeeze::shaped : Squeeze::none;
    return compares_with_rest(region) ? Squeeze::relative : straight;
}

SetupRegion setup_of(const RegionInput& region, double radius, bool shape) {
    SetupRegion setup = {};
    setup.length = static_cast<float>(region.length);
    setup.per_length = static_cast<float>(1 / region.length);
    setup.radius = static_cast<float>(radius);
    setup.max_angle = static_cast<float>(region.max_angle);
    setup.relative = squeeze_of(region, shape) == Squeeze::relative;
    setup.shaped = shape;
    setup.onset = static_cast<float>(region.onset);
    setup.rest_angle = static_cast<float>(region.rest_angle);
    setup.rest_direction = wrapped_direction(static_cast<float>(region.rest_direction));
    if (region.table.empty()) return setup;
    setup.rows = reinterpret_cast<const float(*)[amplitude_terms]>(region.table.rows.front().data());
    setup.row_count = region.table.rows.size();
    setup.table_max_angle = region.table.max_angle;
    return setup;
}

/// For vertices of `own` near its joint with `neighbor`. `gain`: the neighbor's wave over the own one there;
/// `toward`: 1 where the region ends, -1 where it begins.
JointBlend blend_between(const BodyData& data, const RegionInput& own, const RegionInput& neighbor,
                         double blend, double gain, double toward) {
    const double steps = own.length / blend;
    const double scale = radius_of(own, data.radius) / radius_of(neighbor, data.radius);
    JointBlend joint = {};
    joint.at = static_cast<float>(1 - steps / 2);
    joint.per_height = static_cast<float>(toward * steps);
    joint.per_length = static_cast<float>(toward / blend);
    joint.squeeze = static_cast<float>(scale);
    // Squeezes that are relative have the radius about a vertex in them, others as a factor on T and its
    // root.
    const bool relative = compares_with_rest(own);
    double factor = relative ? gain : gain * std::sqrt(scale);
    for (float& term : joint.gain) {
        term = static_cast<float>(factor);
        if (!relative) factor *= scale;
    }
    return joint;
}

/// Sets the joints of region `r`, and which of its vertices are near them.
void set_joints(const BodyData& data, std::size_t r, RegionData& details) {
    const RegionInput& own = data.inputs[r];
    const auto [first, last] = std::pair(data.regions[r].first, data.regions[r].last);
    Joint &below = details.below, &above = details.above;
    below.first = below.last = first;
    above.first = above.last = last;
    const float* const height = data.columns.height;
    const auto split = [height](std::size_t from, std::size_t to, const auto& before) {
        return static_cast<std::size_t>(std::partition_point(height + from, height + to, before) - height);
    };
    if (r > 0 && data.inputs[r - 1].blend != 0) {
        const RegionInput& before = data.inputs[r - 1];
        below.blend = blend_between(data, own, before, before.blend, 1 / before.blend_gain, -1);
        below.neighbor = r - 1;
        below.last = split(first, last, [&](float v) { return below.nears(v); });
    }
    if (own.blend != 0) {
        above.blend = blend_between(data, own, data.inputs[r + 1], own.blend, own.blend_gain, 1);
        above.neighbor = r + 1;
        above.first = split(below.last, last, [&](float v) { return !above.nears(v); });
    }
}

}  // namespace

void set_frame(BodyData& data, const glm::dvec3& origin, const glm::dmat3& axes, double radius) noexcept {
    data.origin = origin;
    data.axes = axes;
    data.radius = radius;
    data.base = frame_of(origin, axes);
}

void add_region(BodyData& data, const RegionInput& input, const Bands& bands) {
    const bool shape = data.columns.scale != nullptr;
    const double radius = radius_of(input, data.radius);
    data.regions.push_back(region_of(input, data.regions.empty() ? 0 : data.regions.back().last));
    RegionData& details = data.details.emplace_back();
    details.setup = setup_of(input, radius, shape);
    details.squeeze = squeeze_of(input, shape);
    details.factors = &input.factors;
    details.bands = bands;
    data.length += input.length;
    set_joints(data, data.regions.size() - 1, details);
}

}  // namespace goffer::bend
