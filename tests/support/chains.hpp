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

/// `test_mesh`, which is straight, bent: its mesh then has the rest arc that its cylinder says.
inline TestMesh bent_at_rest(TestMesh test_mesh, double angle, double direction) {
    fit::Cylinder& c = test_mesh.cylinder;
    const paper::ClosedForm map({.length = c.length, .radius = c.radius}, {angle, direction});
    const glm::dmat3 axes(c.zero, glm::cross(c.axis, c.zero), c.axis);
    for (std::size_t i = 0; i < test_mesh.positions.size(); ++i) {
        const paper::Cylindrical at =
            paper::to_cylindrical(glm::transpose(axes) * (glm::dvec3(test_mesh.positions[i]) - c.origin));
        const auto components = [&](const glm::dvec3& vector) {
            const paper::Pose straight;
            return paper::straightened_normal(glm::transpose(axes) * vector, at, c.length, c.radius,
                                              straight);
        };
        const glm::dvec3 normal = axes * map.normal(at, components(glm::dvec3(test_mesh.normals[i])));
        const glm::dvec3 tangent = axes * map.tangent(at, components(glm::dvec3(test_mesh.tangents[i])));
        test_mesh.positions[i] = c.origin + axes * map.position(at);
        test_mesh.normals[i] = normal;
        test_mesh.tangents[i] = glm::vec4(glm::vec3(tangent), test_mesh.tangents[i].w);
    }
    c.rest_angle = angle;
    c.rest_direction = direction;
    return test_mesh;
}

/// The closed form of `bound`'s deformation in double, in model space, for the body's vertices.
class ChainReference {
public:
    ChainReference(const TestMesh& test_mesh, const fit::BindOptions& options, const fit::Binding& binding,
                   std::span<const bend::Pose> poses)
        : test_mesh_(test_mesh),
          binding_(binding),
          axes_(test_mesh.cylinder.zero, glm::cross(test_mesh.cylinder.axis, test_mesh.cylinder.zero),
                test_mesh.cylinder.axis),
          rest_{test_mesh.cylinder.rest_angle, test_mesh.cylinder.rest_direction},
          chain_(regions(test_mesh.cylinder, options, binding), doubled(poses)) {}

    [[nodiscard]] glm::dvec3 position(std::size_t i) const {
        const At at = rest(i);
        return test_mesh_.cylinder.origin + axes_ * chain_.position(at.region, at.local);
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.normals[at.vertex]);
        return axes_ * chain_.normal(at.region, at.local,
                                     paper::straightened_normal(glm::transpose(axes_) * own, at.whole,
                                                                test_mesh_.cylinder.length,
                                                                test_mesh_.cylinder.radius, rest_));
    }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.tangents[at.vertex]);
        return axes_ * chain_.tangent(at.region, at.local,
                                      paper::straightened_tangent(glm::transpose(axes_) * own, at.whole,
                                                                  test_mesh_.cylinder.length,
                                                                  test_mesh_.cylinder.radius, rest_));
    }

private:
    struct At {
        std::size_t vertex, region;
        paper::Cylindrical whole, local;
    };

    [[nodiscard]] At rest(std::size_t i) const {
        At at{};
        at.vertex = binding_.order.empty() ? i : binding_.order[i];
        const glm::dvec3 point = glm::transpose(axes_) *
                                 (glm::dvec3(test_mesh_.positions[at.vertex]) - test_mesh_.cylinder.origin);
        at.whole =
            paper::to_cylindrical(point, test_mesh_.cylinder.length, test_mesh_.cylinder.radius, rest_);
        at.local = at.whole;
        const std::span<const bend::Region> regions = binding_.body.regions();
        while (i >= regions[at.region].last) at.local.z -= binding_.regions[at.region++].length;
        return at;
    }

    static std::vector<paper::Parameters> regions(const fit::Cylinder& cylinder,
                                                  const fit::BindOptions& options,
                                                  const fit::Binding& binding) {
        std::vector<paper::Parameters> bodies;
        for (std::size_t r = 0; r < binding.regions.size(); ++r) {
            paper::Parameters body{binding.regions[r].length, cylinder.radius, binding.regions[r].folds,
                                   options.profile, options.amplitude};
            body.rest_angle = cylinder.rest_angle * body.length / cylinder.length;
            body.rest_direction = cylinder.rest_direction;
            body.onset = static_cast<double>(binding.body.regions()[r].onset);
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

    const TestMesh& test_mesh_;
    const fit::Binding& binding_;
    glm::dmat3 axes_;
    paper::Pose rest_;
    paper::Chain chain_;
};

}  // namespace goffer::test
