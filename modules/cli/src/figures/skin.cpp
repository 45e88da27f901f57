// SPDX-License-Identifier: MIT
#include "figures/skin.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::cli {

Skin::Skin(const BoundModel& model, int bones) : model_(model), bones_(bones) {
    const glm::dmat3 axes = model.binding.body.axes();
    const double direction = model.cylinder.rest_direction;
    along_ = axes[2];
    toward_ = std::cos(direction) * axes[0] + std::sin(direction) * axes[1];
    for (const double z : fit::heights(model.rest.positions, model.cylinder)) {
        const double middle = z / model.cylinder.length * bones - 0.5;
        const double bone = std::clamp(std::floor(middle), 0.0, bones - 2.0);
        weights_.push_back({static_cast<std::size_t>(bone), std::clamp(middle - bone, 0.0, 1.0)});
    }
}

std::vector<glm::dvec3> Skin::joints() const {
    const fit::Cylinder& cylinder = model_.cylinder;
    const double angle = cylinder.rest_angle, radius = fit::rest_radius(cylinder);
    std::vector<glm::dvec3> joints;
    for (int i = 0; i < bones_; ++i) {
        const double share = static_cast<double>(i) / bones_, turn = angle * share;
        const double aside = angle == 0 ? 0 : radius * (1 - std::cos(turn));
        const double along = angle == 0 ? cylinder.length * share : radius * std::sin(turn);
        joints.push_back(cylinder.origin + aside * toward_ + along * along_);
    }
    return joints;
}

std::vector<glm::dmat4> Skin::moves(double by) const {
    const std::vector<glm::dvec3> rest = joints();
    const glm::dvec3 axis = glm::cross(along_, toward_);
    std::vector<glm::dmat4> moves;
    glm::dvec3 joint = rest[0];
    for (int i = 0; i < bones_; ++i) {
        const std::size_t bone = static_cast<std::size_t>(i);
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), by * i / (bones_ - 1), axis);
        moves.push_back(glm::translate(glm::dmat4(1), joint) * turn *
                        glm::translate(glm::dmat4(1), -rest[bone]));
        if (i + 1 < bones_) joint += glm::dvec3(turn * glm::dvec4(rest[bone + 1] - rest[bone], 0));
    }
    return moves;
}

std::vector<glm::vec3> Skin::positions(double by) const {
    const std::vector<glm::dmat4> moved = moves(by);
    std::vector<glm::vec3> result;
    result.reserve(weights_.size());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        const auto [bone, next] = weights_[i];
        const glm::dvec4 position(glm::dvec3(model_.rest.positions[i]), 1);
        result.emplace_back((1 - next) * (moved[bone] * position) + next * (moved[bone + 1] * position));
    }
    return result;
}

}  // namespace goffer::cli
