// SPDX-License-Identifier: MIT
#include "goffer/paper/chain.hpp"

#include "bend.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace goffer::paper {

Frame end_frame(const Frame& base, const Parameters& body, const Pose& pose) {
    const Bend bend = bend_of(body, pose);
    // The end's cross-section is the base's, turned by alpha in the bend plane: each axis is taken apart into
    // what lies in that plane and what does not.
    const double c = std::cos(bend.theta), s = std::sin(bend.theta);
    const double ca = std::cos(bend.alpha), sa = std::sin(bend.alpha);
    const glm::dvec3 n{c * ca, s * ca, -sa}, b{-s, c, 0}, t{c * sa, s * sa, ca};
    Frame end;
    end.axes = base.axes * glm::dmat3{c * n - s * b, s * n + c * b, t};
    end.origin = base.origin + base.axes * bend.position({0, body.length, 0}, 0);
    return end;
}

namespace {

/// Whether the wave of one region runs on in the next one.
bool runs_on(const FoldRange& folds, const FoldRange& next) {
    return folds.count > 0 && next.count > 0 && folds.total == next.total &&
           folds.before + folds.count == next.before;
}

}  // namespace

double share_of_neighbor(double distance, double blend) {
    const double x = std::clamp(1 - distance / blend, 0.0, 1.0);
    return x * x * (1.5 - x);
}

Chain::Chain(std::span<const Parameters> regions, std::span<const Pose> poses, std::span<const double> blends)
    : regions_(regions.begin(), regions.end()), ends_(regions.size()) {
    if (regions.empty() || regions.size() != poses.size()) {
        throw std::invalid_argument("poses: " + std::to_string(poses.size()) + " for " +
                                    std::to_string(regions.size()) + " regions: it must be one for each");
    }
    frames_.emplace_back();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        maps_.emplace_back(regions[i], poses[i]);
        frames_.push_back(end_frame(frames_[i], regions[i], poses[i]));
    }
    if (!blends.empty() && blends.size() + 1 != regions.size()) {
        throw std::invalid_argument("blends: " + std::to_string(blends.size()) + " for " +
                                    std::to_string(regions.size()) +
                                    " regions: it must be one for each joint");
    }
    for (std::size_t i = 0; i < blends.size(); ++i) {
        if (blends[i] != 0) add_joint(i, blends[i]);
    }
}

void Chain::add_joint(std::size_t region, double blend) {
    const Parameters &own = regions_[region], &next = regions_[region + 1];
    if (!runs_on(own.folds, next.folds))
        throw std::invalid_argument("blends: no wave runs over the joint behind region " +
                                    std::to_string(region));
    if (!(blend > 0 && ends_[region].below.blend + blend <= own.length && blend <= next.length))
        throw std::invalid_argument("blends: " + std::to_string(blend) + " does not lie within the regions");
    const double depth = wave_depth(own.shape.get(), own.length),
                 next_depth = wave_depth(next.shape.get(), 0);
    if (!(depth > 0 && next_depth > 0))
        throw std::invalid_argument("blends: the wave has no depth at the joint behind region " +
                                    std::to_string(region));
    const double gain = next_depth / depth;
    const double radius_ratio = own.radius / next.radius;
    ends_[region].above = {blend, gain, radius_ratio};
    ends_[region + 1].below = {blend, 1 / gain, 1 / radius_ratio};
}

Depth Chain::depth(std::size_t region, const Cylindrical& rest) const {
    const double scale = maps_[region].scale(rest.z), length = regions_[region].length;
    const auto& [below, above] = ends_[region];
    Depth depth = maps_[region].depth(rest.beta, scale);
    const auto blend_with = [&](std::size_t neighbor, const Side& side, double distance, double toward) {
        if (side.blend == 0 || distance >= side.blend) return;
        const Depth other = maps_[neighbor].depth(rest.beta, scale * side.radius_ratio);
        const double x = std::min(1 - distance / side.blend, 1.0);
        const double share = share_of_neighbor(distance, side.blend),
                     share_slope = 3 * x * (1 - x) / side.blend;
        depth.by_z = toward * share_slope * (side.gain * other.amplitude - depth.amplitude);
        depth.by_scale += share * (side.gain * side.radius_ratio * other.by_scale - depth.by_scale);
        depth.by_beta += share * (side.gain * other.by_beta - depth.by_beta);
        depth.amplitude += share * (side.gain * other.amplitude - depth.amplitude);
    };
    blend_with(region - 1, below, rest.z, -1);
    blend_with(region + 1, above, length - rest.z, 1);
    return depth;
}

glm::dvec3 Chain::position(std::size_t region, const Cylindrical& rest) const {
    return frames_[region].origin + frames_[region].axes * maps_[region].position(rest, depth(region, rest));
}

glm::dvec3 Chain::normal(std::size_t region, const Cylindrical& rest,
                         const CylindricalVector& rest_normal) const {
    return frames_[region].axes * maps_[region].normal(rest, rest_normal, depth(region, rest));
}

glm::dvec3 Chain::tangent(std::size_t region, const Cylindrical& rest,
                          const CylindricalVector& rest_tangent) const {
    return frames_[region].axes * maps_[region].tangent(rest, rest_tangent, depth(region, rest));
}

}  // namespace goffer::paper
