// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"

#include <goffer/paper/chain.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <memory>
#include <span>
#include <vector>

/// Bodies of several regions, and bodies that are bent at rest, with the double reference of both.

namespace goffer::test {

/// The shape of all of a cylinder; null without radii.
inline std::shared_ptr<const paper::Shape> shape_of(const fit::Cylinder& c) {
    if (c.radii.empty()) return nullptr;
    return std::make_shared<const paper::Shape>(c.length, c.radius, paper::Shape::Knots{.radius = c.radii});
}

/// `test_mesh`, which is straight, bent: its mesh then has the rest arc that its cylinder says.
inline TestMesh bent_at_rest(TestMesh test_mesh, double angle, double direction) {
    fit::Cylinder& c = test_mesh.cylinder;
    paper::Parameters bare{.length = c.length, .radius = c.radius};
    bare.shape = shape_of(c);
    const paper::ClosedForm map(bare, {angle, direction});
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
          shape_(shape_of(binding.cylinder)),
          chain_(regions(options, binding), doubled(poses), blends(binding)) {}

    [[nodiscard]] glm::dvec3 position(std::size_t i) const {
        const At at = rest(i);
        return test_mesh_.cylinder.origin + axes_ * chain_.position(at.region, at.local);
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.normals[at.vertex]);
        return axes_ * chain_.normal(at.region, at.local,
                                     paper::straightened_normal(
                                         glm::transpose(axes_) * own, at.whole, binding_.cylinder.length,
                                         binding_.cylinder.radius, rest_, shape_.get()));
    }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.tangents[at.vertex]);
        return axes_ * chain_.tangent(at.region, at.local,
                                      paper::straightened_tangent(
                                          glm::transpose(axes_) * own, at.whole, binding_.cylinder.length,
                                          binding_.cylinder.radius, rest_, shape_.get()));
    }

    /// A place of region `region`, which counts z from where that begins.
    [[nodiscard]] glm::dvec3 place(std::size_t region, const paper::Cylindrical& rest) const {
        return test_mesh_.cylinder.origin + axes_ * chain_.position(region, rest);
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
        at.whole = paper::to_cylindrical(point, binding_.cylinder.length, binding_.cylinder.radius, rest_);
        if (shape_ && rest_.angle != 0)
            at.whole.z = shape_->unshifted(at.whole.z, rest_.angle / binding_.cylinder.length);
        at.local = at.whole;
        const std::span<const bend::Region> regions = binding_.body.regions();
        while (i >= regions[at.region].last) at.local.z -= binding_.regions[at.region++].length;
        return at;
    }

    static std::vector<paper::Parameters> regions(const fit::BindOptions& options,
                                                  const fit::Binding& binding) {
        std::vector<paper::Parameters> bodies;
        for (std::size_t r = 0; r < binding.regions.size(); ++r)
            bodies.push_back(parameters_of(binding, options, r));
        return bodies;
    }

    static std::vector<double> blends(const fit::Binding& binding) {
        std::vector<double> result;
        for (const fit::RegionBinding& region : binding.regions) result.push_back(region.blend);
        result.pop_back();
        return result;
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
    std::shared_ptr<const paper::Shape> shape_;
    paper::Chain chain_;
};

}  // namespace goffer::test
