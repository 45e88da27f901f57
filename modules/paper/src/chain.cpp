// SPDX-License-Identifier: MIT
#include "goffer/paper/chain.hpp"

#include "bend.hpp"

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

Chain::Chain(std::span<const Parameters> regions, std::span<const Pose> poses) {
    if (regions.empty() || regions.size() != poses.size()) {
        throw std::invalid_argument("poses: " + std::to_string(poses.size()) + " for " +
                                    std::to_string(regions.size()) + " regions: it must be one for each");
    }
    frames_.emplace_back();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        maps_.emplace_back(regions[i], poses[i]);
        frames_.push_back(end_frame(frames_[i], regions[i], poses[i]));
    }
}

glm::dvec3 Chain::position(std::size_t region, const Cylindrical& rest) const {
    return frames_[region].origin + frames_[region].axes * maps_[region].position(rest);
}

glm::dvec3 Chain::normal(std::size_t region, const Cylindrical& rest,
                         const CylindricalVector& rest_normal) const {
    return frames_[region].axes * maps_[region].normal(rest, rest_normal);
}

glm::dvec3 Chain::tangent(std::size_t region, const Cylindrical& rest,
                          const CylindricalVector& rest_tangent) const {
    return frames_[region].axes * maps_[region].tangent(rest, rest_tangent);
}

}  // namespace goffer::paper
