// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"

#include <goffer/paper/chain.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <span>
#include <vector>

/// Bodies of several regions, and bodies that are bent at rest, with the double reference of both.

namespace goffer::test {

/// `subject`, which is straight, bent: its mesh then has the rest arc that its cylinder says.
inline Subject bent_at_rest(Subject subject, double angle, double direction) {
    fit::Cylinder& c = subject.cylinder;
    const paper::ClosedForm map({.length = c.length, .radius = c.radius}, {angle, direction});
    const glm::dmat3 axes(c.zero, glm::cross(c.axis, c.zero), c.axis);
    for (std::size_t i = 0; i < subject.positions.size(); ++i) {
        const paper::Cylindrical at =
            paper::to_cylindrical(glm::transpose(axes) * (glm::dvec3(subject.positions[i]) - c.origin));
        const auto components = [&](const glm::dvec3& vector) {
            const paper::Pose straight;
            return paper::straightened_normal(glm::transpose(axes) * vector, at, c.length, c.radius,
                                              straight);
        };
        const glm::dvec3 normal = axes * map.normal(at, components(glm::dvec3(subject.normals[i])));
        const glm::dvec3 tangent = axes * map.tangent(at, components(glm::dvec3(subject.tangents[i])));
        subject.positions[i] = c.origin + axes * map.position(at);
        subject.normals[i] = normal;
        subject.tangents[i] = glm::vec4(glm::vec3(tangent), subject.tangents[i].w);
    }
    c.rest_angle = angle;
    c.rest_direction = direction;
    return subject;
}

/// The closed form of `bound`'s deformation in double, in model space, for the body's vertices.
class ChainReference {
public:
    ChainReference(const Subject& subject, const fit::BindOptions& options, const fit::Bound& bound,
                   std::span<const bend::Pose> poses)
        : subject_(subject),
          bound_(bound),
          axes_(subject.cylinder.zero, glm::cross(subject.cylinder.axis, subject.cylinder.zero),
                subject.cylinder.axis),
          rest_{subject.cylinder.rest_angle, subject.cylinder.rest_direction},
          chain_(regions(subject.cylinder, options, bound), doubled(poses)) {}

    [[nodiscard]] glm::dvec3 position(std::size_t i) const {
        const At at = rest(i);
        return subject_.cylinder.origin + axes_ * chain_.position(at.region, at.local);
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(subject_.normals[at.vertex]);
        return axes_ * chain_.normal(at.region, at.local,
                                     paper::straightened_normal(glm::transpose(axes_) * own, at.whole,
                                                                subject_.cylinder.length,
                                                                subject_.cylinder.radius, rest_));
    }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(subject_.tangents[at.vertex]);
        return axes_ * chain_.tangent(at.region, at.local,
                                      paper::straightened_tangent(glm::transpose(axes_) * own, at.whole,
                                                                  subject_.cylinder.length,
                                                                  subject_.cylinder.radius, rest_));
    }

private:
    struct At {
        std::size_t vertex, region;
        paper::Cylindrical whole, local;
    };

    [[nodiscard]] At rest(std::size_t i) const {
        At at{};
        at.vertex = bound_.order.empty() ? i : bound_.order[i];
        const glm::dvec3 point =
            glm::transpose(axes_) * (glm::dvec3(subject_.positions[at.vertex]) - subject_.cylinder.origin);
        at.whole = paper::to_cylindrical(point, subject_.cylinder.length, subject_.cylinder.radius, rest_);
        at.local = at.whole;
        const std::span<const bend::Region> regions = bound_.body.regions();
        while (i >= regions[at.region].last) at.local.z -= bound_.regions[at.region++].length;
        return at;
    }

    static std::vector<paper::Body> regions(const fit::Cylinder& cylinder, const fit::BindOptions& options,
                                            const fit::Bound& bound) {
        std::vector<paper::Body> bodies;
        for (std::size_t r = 0; r < bound.regions.size(); ++r) {
            paper::Body body{bound.regions[r].length, cylinder.radius, bound.regions[r].folds,
                             options.profile, options.amplitude};
            body.rest_angle = cylinder.rest_angle * body.length / cylinder.length;
            body.rest_direction = cylinder.rest_direction;
            body.onset = static_cast<double>(bound.body.regions()[r].onset);
            bodies.push_back(body);
        }
        return bodies;
    }

    static std::vector<paper::Pose> doubled(std::span<const bend::Pose> poses) {
        std::vector<paper::Pose> result;
        for (const bend::Pose& pose : poses)
            result.push_back({static_cast<double>(pose.angle), static_cast<double>(pose.direction)});
        return result;
    }

    const Subject& subject_;
    const fit::Bound& bound_;
    glm::dmat3 axes_;
    paper::Pose rest_;
    paper::Chain chain_;
};

}  // namespace goffer::test
