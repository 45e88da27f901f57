// SPDX-License-Identifier: MIT
#include "body/joint.hpp"

#include "body/body_data.hpp"
#include "kernel/neighbor.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

/// kappa_0 and rest_curl of a region: see CoefficientsOf.
glm::dvec3 rest_squeeze(const RegionInput& region, double radius) noexcept {
    const double kappa = region.rest_angle * radius / region.length;
    return kappa * glm::dvec3(1, std::cos(region.rest_direction), std::sin(region.rest_direction));
}

/// Sets what `joint` has of the rest arcs on both sides, if these are not parts of one.
void set_arcs(const RegionInput& own, const RegionInput& neighbor, double radius,
              JointBlend& joint) noexcept {
    if (share_rest_arc(own, neighbor, radius)) return;
    const double own_radius = radius_of(own, radius);  // s is over that of the region itself
    const glm::dvec3 change = rest_squeeze(own, own_radius) - rest_squeeze(neighbor, own_radius);
    joint.rest_kappa = static_cast<float>(change[0]);
    for (int i = 0; i < 2; ++i) joint.rest_curl[i] = static_cast<float>(change[i + 1]);
}

/// `gain`: the neighbor's wave over the own one at the joint; `toward`: 1 where the region ends, -1 where it
/// begins.
JointBlend blend_between(const RegionInput& own, const RegionInput& neighbor, double radius, double blend,
                         double gain, double toward) noexcept {
    const double steps = own.length / blend;
    const double scale = radius_of(own, radius) / radius_of(neighbor, radius);
    JointBlend joint = {};
    joint.at = static_cast<float>(1 - steps / 2);
    joint.per_height = static_cast<float>(toward * steps);
    joint.per_length = static_cast<float>(toward / blend);
    joint.radius_ratio = static_cast<float>(scale);
    set_arcs(own, neighbor, radius, joint);
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

}  // namespace

bool share_rest_arc(const RegionInput& a, const RegionInput& b, double radius) noexcept {
    if (a.rest_angle == 0 && b.rest_angle == 0) return true;
    constexpr double tolerance = 1e-6;
    const double curvature = a.rest_angle / a.length, other = b.rest_angle / b.length;
    const double turned = std::remainder(a.rest_direction - b.rest_direction, 2 * std::numbers::pi);
    return std::fabs(curvature - other) <= tolerance * curvature && std::fabs(turned) <= tolerance &&
           radius_of(a, radius) == radius_of(b, radius);
}

Joints joints_of(std::span<const RegionInput> regions, std::size_t r, double radius) noexcept {
    Joints joints;
    const RegionInput& own = regions[r];
    if (r > 0 && regions[r - 1].blend != 0) {
        const RegionInput& before = regions[r - 1];
        joints.below.blend = blend_between(own, before, radius, before.blend, 1 / before.blend_gain, -1);
        joints.below.neighbor = r - 1;
    }
    if (r + 1 < regions.size() && own.blend != 0) {
        joints.above.blend = blend_between(own, regions[r + 1], radius, own.blend, own.blend_gain, 1);
        joints.above.neighbor = r + 1;
    }
    return joints;
}

bool find_vertices(Joints& joints, const RestColumns& columns, std::size_t first, std::size_t last) noexcept {
    auto& [below, above] = joints;
    below.first = below.last = first;
    above.first = above.last = last;
    below.max_scale = above.max_scale = columns.scale != nullptr ? 0.0f : 1.0f;
    for (std::size_t i = first; i < last && (below.blends() || above.blends()); ++i) {
        for (Joint* joint : {&below, &above}) {
            if (!joint->nears(columns.height[i])) continue;
            if (joint == &below) below.last = i + 1;
            if (joint == &above) above.first = std::min(above.first, i);
            if (columns.scale != nullptr) joint->max_scale = std::max(joint->max_scale, columns.scale[i]);
        }
    }
    const bool apart = below.last <= above.first;
    if (!apart) above.first = below.last;
    return apart;
}

void set_as_own(const Coefficients& neighbor, const JointBlend& joint, bool relative,
                Coefficients& own) noexcept {
    take_as_own(neighbor, joint, relative, own,
                [](float from, float factor, float& to) { to = factor * from; });
}

}  // namespace goffer::bend
