// SPDX-License-Identifier: MIT
#include "body/check.hpp"

#include "body/body_data.hpp"

#include <goffer/bend/body_input.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace goffer::bend {
namespace {

using Range = WorkingRange;

/// A number and the range that it must lie in.
struct Limited {
    BodyField field;
    double value;
    double low, high;
};

Reason reason_of(double value, double low, double high) noexcept {
    if (!std::isfinite(value)) return Reason::not_finite;
    return value >= low && value <= high ? Reason::none : Reason::out_of_range;
}

BodyFault first_fault(std::span<const Limited> numbers, std::size_t index) noexcept {
    for (const Limited& number : numbers) {
        const Reason reason = reason_of(number.value, number.low, number.high);
        if (reason != Reason::none) return {number.field, reason, index};
    }
    return {};
}

BodyFault check_origin(const glm::dvec3& origin) noexcept {
    constexpr double most = Range::max_origin;
    const Limited numbers[] = {{BodyField::origin, origin.x, -most, most},
                               {BodyField::origin, origin.y, -most, most},
                               {BodyField::origin, origin.z, -most, most}};
    return first_fault(numbers, BodyFault::nowhere);
}

BodyFault check_axes(const glm::dmat3& axes) noexcept {
    constexpr double tolerance = 1e-6;
    bool rotation = true;
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(axes[i]), across = glm::dot(axes[i], axes[(i + 1) % 3]);
        if (!std::isfinite(length)) return {BodyField::axes, Reason::not_finite};
        rotation = rotation && std::fabs(length - 1) <= tolerance && std::fabs(across) <= tolerance;
    }
    if (rotation && glm::determinant(axes) > 0) return {};
    return {BodyField::axes, Reason::out_of_range};
}

/// Checks the rows and the largest angle of a WrinkleTable or a FactorTable.
template <class Table>
Reason check_table(const Table& table) noexcept {
    if (table.empty()) return Reason::none;
    if (table.rows.size() < 2) return Reason::count;
    for (const auto& row : table.rows) {
        const bool finite = std::ranges::all_of(row, [](float value) { return std::isfinite(value); });
        if (!finite) return Reason::not_finite;
    }
    const auto angle = static_cast<double>(table.max_angle);
    return reason_of(angle, Range::min_angle, static_cast<double>(std::numeric_limits<float>::max()));
}

/// The largest factor on the amplitude: 1 without a table.
double max_factor(const FactorTable& factors) noexcept {
    float square = factors.empty() ? 1.0f : 0.0f;
    for (const auto& row : factors.rows) square = std::max(square, *std::ranges::max_element(row));
    return std::sqrt(static_cast<double>(square));
}

/// Upper bounds for a region's wrinkle in any pose.
struct Wrinkle {
    double depth = 0;      ///< of the amplitude A, or of A / S_0
    double amplitude = 0;  ///< of the coefficients that kernels evaluate
};

/// For a relative squeeze, kernels evaluate a polynomial in q, whose coefficients are the row's divided by
/// powers of kappa (taken as at least 1e-4). A row has an effect from the angle of the row before it on. q /
/// kappa stays below 4.5, since a column that was shortened at rest is squeezed only where kappa is large.
Wrinkle wrinkle_of(const RegionInput& region, double radius) noexcept {
    const bool relative = compares_with_rest(region);
    const double per_angle = radius / region.length, max_scale = region.max_scale;
    const double root = relative ? 1.1 : std::sqrt(2 * region.max_angle * per_angle * max_scale);
    const double step = max_scale * (relative ? 4.5 : 2), factor = max_factor(region.factors);
    const auto& rows = region.table.rows;
    Wrinkle largest;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double share = i == 0 ? 0 : static_cast<double>(i - 1) / static_cast<double>(rows.size() - 1);
        const double kappa = share * share * static_cast<double>(region.table.max_angle) * per_angle;
        const double per_power = relative ? 1 / std::max(kappa, 1e-4) : 1;
        double depth = 0, power = 1, scale = factor;
        for (const float coefficient : rows[i]) {
            const double size = std::fabs(static_cast<double>(coefficient));
            depth += size * power;
            largest.amplitude = std::max(largest.amplitude, size * scale);
            power *= step;
            scale *= per_power;
        }
        largest.depth = std::max(largest.depth, root * factor * depth);
    }
    return largest;
}

/// The wrinkle of `neighbor` near a joint, as one of `own`. `gain`: the neighbor's wave over the own one
/// there.
Wrinkle wrinkle_beyond(const RegionInput& own, const RegionInput& neighbor, double gain,
                       double radius) noexcept {
    const double beyond = radius_of(neighbor, radius), scale = radius_of(own, radius) / beyond;
    Wrinkle wrinkle = wrinkle_of(neighbor, beyond);
    wrinkle.depth *= gain;
    wrinkle.amplitude *= gain * std::pow(std::max(scale, 1.0), wrinkle_degree + 0.5);
    return wrinkle;
}

bool wrinkle_fits(const Wrinkle& wrinkle) noexcept {
    // Those of the slope are up to 15 times as large, and still float.
    constexpr double max_coefficient = 1e36;
    return wrinkle.depth <= Range::max_depth && wrinkle.amplitude <= max_coefficient;
}

BodyFault check_region(const RegionInput& region, std::size_t index, double body_radius) noexcept {
    const double radius = radius_of(region, body_radius);
    const double most = region.length / (2 * radius * region.max_scale);
    const double max_angle = std::min(most * (1 + 1e-6), Range::max_angle);
    const double max_rest = std::min(most * Range::max_rest, region.max_angle);
    const double max_direction = Range::max_angle;
    const Limited numbers[] = {
        {BodyField::length, region.length, Range::min_length, Range::max_length},
        {BodyField::region_radius, radius, Range::min_length, Range::max_length},
        {BodyField::max_scale, region.max_scale, 1, Range::max_scale},
        {BodyField::max_angle, region.max_angle, Range::min_angle, max_angle},
        {BodyField::rest_angle, region.rest_angle, 0, max_rest},
        {BodyField::rest_direction, region.rest_direction, -max_direction, max_direction},
        {BodyField::onset, region.onset, 0, 1}};
    if (const BodyFault fault = first_fault(numbers, index); !fault.none()) return fault;
    if (const Reason reason = check_table(region.factors); reason != Reason::none)
        return {BodyField::factors, reason, index};
    Reason reason = check_table(region.table);
    if (reason == Reason::none && !wrinkle_fits(wrinkle_of(region, radius))) reason = Reason::out_of_range;
    return reason == Reason::none ? BodyFault{} : BodyFault{BodyField::table, reason, index};
}

BodyFault check_counts(const BodyInput& input) noexcept {
    if (input.vertices.empty()) return {BodyField::vertices, Reason::empty};
    std::size_t left = input.vertices.size();
    for (const RegionInput& region : input.regions) {
        if (region.vertex_count > left) return {BodyField::vertex_count, Reason::count};
        left -= region.vertex_count;
    }
    return left == 0 ? BodyFault{} : BodyFault{BodyField::vertex_count, Reason::count};
}

/// Whether wrinkles may pass between regions that are bent along different arcs at rest: columns near the
/// joint must not be squeezed to nothing in either, whose squeezes are compared there.
bool bears_other_arc(const RegionInput& a, const RegionInput& b, double radius) noexcept {
    const auto bears = [radius](const RegionInput& region) {
        const double most = region.length / (2 * radius_of(region, radius) * region.max_scale);
        return region.rest_angle <= most * Range::max_joint_rest;
    };
    return bears(a) && bears(b);
}

/// Checks what region `r` says of its joint with the next one.
BodyFault check_joint(const BodyInput& input, std::size_t r) noexcept {
    const RegionInput& own = input.regions[r];
    if (!std::isfinite(own.blend_gain)) return {BodyField::blend_gain, Reason::not_finite, r};
    if (own.blend == 0) return {};
    const BodyFault blend{BodyField::blend, Reason::out_of_range, r};
    if (!std::isfinite(own.blend)) return {BodyField::blend, Reason::not_finite, r};
    if (r + 1 == input.regions.size()) return blend;
    const RegionInput& next = input.regions[r + 1];
    constexpr double least = 1e-5;  // of a region's length
    const double before = r == 0 ? 0 : input.regions[r - 1].blend,
                 longest = std::max(own.length, next.length);
    const bool fits = own.blend >= least * longest && before + own.blend <= own.length * (1 + 1e-9) &&
                      own.blend + next.blend <= next.length * (1 + 1e-9);
    const double radius = radius_of(own, input.radius), next_radius = radius_of(next, input.radius);
    const bool similar = radius <= next_radius * Range::max_scale && next_radius <= radius * Range::max_scale;
    const bool alike = similar && compares_with_rest(own) == compares_with_rest(next) &&
                       (share_rest_arc(own, next, input.radius) || bears_other_arc(own, next, input.radius));
    if (!fits || !alike || own.table.empty() || next.table.empty()) return blend;
    const double most = Range::max_blend_gain;
    const Limited gain{BodyField::blend_gain, own.blend_gain, 1 / most, most};
    if (const BodyFault fault = first_fault({&gain, 1}, r); !fault.none()) return fault;
    const bool below = wrinkle_fits(wrinkle_beyond(own, next, own.blend_gain, input.radius));
    const bool above = wrinkle_fits(wrinkle_beyond(next, own, 1 / own.blend_gain, input.radius));
    return below && above ? BodyFault{} : BodyFault{BodyField::blend_gain, Reason::out_of_range, r};
}

/// Checks that vertices near one joint of region `r` do not lie among those near the other, and what
/// check_near_joints() does. `first`: of the region's vertices; `depth`: of its wrinkles.
BodyFault check_order(const BodyInput& input, std::size_t r, std::size_t first, double depth) noexcept {
    const RegionInput& region = input.regions[r];
    const Joints joints = joints_of(input.regions, r, input.radius);
    if (!joints.below.blends() && !joints.above.blends()) return {};
    bool beyond = false;
    for (std::size_t i = first; i < first + region.vertex_count; ++i) {
        const RestVertex& vertex = input.vertices[i];
        beyond = beyond || joints.above.nears(height_of(vertex, region.length));
        if (beyond && joints.below.nears(height_of(vertex, region.length)))
            return {BodyField::vertices, Reason::out_of_range, i};
        const BodyFault fault = check_near_joints(vertex, i, region.length, depth, joints, input.regions);
        if (!fault.none()) return fault;
    }
    return {};
}

BodyFault check_vertices(const BodyInput& input) noexcept {
    std::size_t i = 0;
    for (const RegionInput& region : input.regions) {
        const auto r = static_cast<std::size_t>(&region - input.regions.data());
        const double radius = radius_of(region, input.radius);
        const double depth = deepest_wrinkle(input.regions, r, input.radius);
        if (const BodyFault fault = check_order(input, r, i, depth); !fault.none()) return fault;
        for (const std::size_t last = i + region.vertex_count; i < last; ++i) {
            const BodyFault fault = check_vertex(input.vertices[i], i, region, radius, depth);
            if (!fault.none()) return fault;
        }
    }
    return {};
}

BodyFault check_units(BodyField field, std::span<const RestVector> vectors, std::size_t count) noexcept {
    if (vectors.size() != count) return {field, Reason::count};
    for (std::size_t i = 0; i < count; ++i) {
        if (const BodyFault fault = check_unit(field, vectors[i], i); !fault.none()) return fault;
    }
    return {};
}

BodyFault check_signs(std::span<const float> signs, std::size_t count) noexcept {
    if (signs.size() != count) return {BodyField::tangent_signs, Reason::count};
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(signs[i])) return {BodyField::tangent_signs, Reason::not_finite, i};
    }
    return {};
}

BodyFault check_frame(const BodyInput& input) noexcept {
    if (const BodyFault fault = check_origin(input.origin); !fault.none()) return fault;
    if (const BodyFault fault = check_axes(input.axes); !fault.none()) return fault;
    const Limited radius{BodyField::radius, input.radius, Range::min_length, Range::max_length};
    return first_fault({&radius, 1}, BodyFault::nowhere);
}

BodyFault check_regions(const BodyInput& input) noexcept {
    if (input.regions.empty()) return {BodyField::regions, Reason::empty};
    if (input.regions.size() > max_regions) return {BodyField::regions, Reason::count};
    for (std::size_t r = 0; r < input.regions.size(); ++r) {
        const BodyFault fault = check_region(input.regions[r], r, input.radius);
        if (!fault.none()) return fault;
    }
    for (std::size_t r = 0; r < input.regions.size(); ++r) {
        if (const BodyFault fault = check_joint(input, r); !fault.none()) return fault;
    }
    return {};
}

BodyFault check_vectors(const BodyInput& input) noexcept {
    const std::size_t count = input.vertices.size();
    if (const BodyFault fault = check_units(BodyField::normals, input.normals, count); !fault.none())
        return fault;
    const std::size_t tangents = input.tangents.empty() ? 0 : count;
    if (const BodyFault fault = check_units(BodyField::tangents, input.tangents, tangents); !fault.none())
        return fault;
    return check_signs(input.tangent_signs, tangents);
}

}  // namespace

double deepest_wrinkle(std::span<const RegionInput> regions, std::size_t r, double radius) noexcept {
    const RegionInput& own = regions[r];
    const double depth = wrinkle_of(own, radius_of(own, radius)).depth;
    double beyond = 0;
    if (r > 0 && regions[r - 1].blend != 0)
        beyond = wrinkle_beyond(own, regions[r - 1], 1 / regions[r - 1].blend_gain, radius).depth;
    if (own.blend != 0)
        beyond = std::max(beyond, wrinkle_beyond(own, regions[r + 1], own.blend_gain, radius).depth);
    return std::max(depth, (depth + beyond) / 2);
}

BodyFault check_rig(const BodyInput& input) noexcept {
    const BodyFault fault = check_frame(input);
    return fault.none() ? check_regions(input) : fault;
}

BodyFault check_vertex(const RestVertex& v, std::size_t index, const RegionInput& region, double radius,
                       double depth) noexcept {
    constexpr double max_wrinkle = Range::max_wrinkle;
    const double slack = 1e-3 * region.length;
    const double growth = depth * std::fabs(v.wrinkle);
    const double reach = region.max_angle * v.rho * (1 + growth) / region.length;
    const double max_drift = region.length * radius * region.max_scale;
    const Limited numbers[] = {
        {BodyField::beta, v.beta, -Range::max_angle, Range::max_angle},
        {BodyField::z, v.z, -slack, region.length + slack},
        {BodyField::rho, v.rho, 0, Range::max_length},
        {BodyField::wrinkle, v.wrinkle, -max_wrinkle, max_wrinkle},
        {BodyField::slope, v.slope, -max_wrinkle, max_wrinkle},
        {BodyField::wrinkle, growth, 0, Range::max_growth},
        {BodyField::slope, depth * std::fabs(v.slope), 0, Range::max_growth},
        {BodyField::rho, reach, 0, Range::max_radius_ratio},
        {BodyField::scale, v.scale, 1 / Range::max_scale, region.max_scale},
        {BodyField::scale_slope, v.scale_slope * region.length / v.scale, -Range::max_taper,
         Range::max_taper},
        {BodyField::scale_slope, growth * v.rho * std::fabs(v.scale_slope) / v.scale, 0, Range::max_growth},
        {BodyField::drift, v.drift, -max_drift, max_drift}};
    return first_fault(numbers, index);
}

BodyFault check_near_joints(const RestVertex& v, std::size_t index, double length, double depth,
                            const Joints& joints, std::span<const RegionInput> regions) noexcept {
    for (const Joint* joint : {&joints.below, &joints.above}) {
        if (!joint->nears(height_of(v, length))) continue;
        if (!bears_scale(joint->blend, v.scale, regions[joint->neighbor].max_scale))
            return {BodyField::scale, Reason::out_of_range, index};
        if (!bears_offset(joint->blend, v.wrinkle * v.rho, depth))
            return {BodyField::wrinkle, Reason::out_of_range, index};
    }
    return {};
}

BodyFault check_unit(BodyField field, const RestVector& vector, std::size_t index) noexcept {
    const auto [rho, beta, z] = vector;
    const Reason reason = reason_of(rho * rho + beta * beta + z * z, 1 - 1e-3, 1 + 1e-3);
    return reason == Reason::none ? BodyFault{} : BodyFault{field, reason, index};
}

BodyFault Body::check(const BodyInput& input) noexcept {
    for (const auto part : {check_rig, check_counts, check_vertices, check_vectors}) {
        if (const BodyFault fault = part(input); !fault.none()) return fault;
    }
    return {};
}

}  // namespace goffer::bend
