// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "kernel/direction.hpp"

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
    setup.rest_direction = wrappable_direction(static_cast<float>(region.rest_direction));
    if (region.table.empty()) return setup;
    setup.rows = reinterpret_cast<const float(*)[amplitude_terms]>(region.table.rows.front().data());
    setup.row_count = region.table.rows.size();
    setup.table_max_angle = region.table.max_angle;
    return setup;
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
    if (!data.details.empty()) data.details.back().setup.last = false;
    RegionData& details = data.details.emplace_back();
    details.setup = setup_of(input, radius, shape);
    details.setup.last = true;
    details.squeeze = squeeze_of(input, shape);
    details.factors = &input.factors;
    details.bands = bands;
    data.length += input.length;
    const std::size_t r = data.regions.size() - 1;
    details.joints = joints_of(data.inputs, r, data.radius);
}

}  // namespace goffer::bend
