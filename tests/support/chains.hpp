// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"

#include <goffer/paper/chain.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <memory>
#include <span>
#include <utility>
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

/// The same along a chain of arcs, with the radii that its cylinder has. Normals and tangents stay as they
/// are: any will do.
inline TestMesh bent_along(TestMesh test_mesh, std::vector<fit::RestArc> arcs) {
    fit::Cylinder& c = test_mesh.cylinder;
    const glm::dmat3 axes(c.zero, glm::cross(c.axis, c.zero), c.axis);
    std::vector<fit::BasePoint> points;
    for (const glm::vec3& position : test_mesh.positions) {
        const paper::Cylindrical at =
            paper::to_cylindrical(glm::transpose(axes) * (glm::dvec3(position) - c.origin));
        points.push_back({at.beta, at.z, at.rho});
    }
    c.arcs = std::move(arcs);
    const std::vector<glm::dvec3> places = fit::places_on_base(c, points);
    test_mesh.positions.assign(places.begin(), places.end());
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
          rest_(bare(regions(options, binding)), rest_poses(regions(options, binding))),
          parameters_(regions(options, binding)),
          chain_(regions(options, binding), doubled(poses), blends(binding)) {}

    [[nodiscard]] glm::dvec3 position(std::size_t i) const {
        const At at = rest(i);
        return test_mesh_.cylinder.origin + axes_ * chain_.position(at.region, at.local);
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.normals[at.vertex]);
        const paper::Parameters& body = parameters_[at.region];
        return axes_ * chain_.normal(at.region, at.local,
                                     paper::straightened_normal(
                                         in_region(at, own), at.local, body.length, body.radius,
                                         {body.rest_angle, body.rest_direction}, body.shape.get()));
    }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const {
        const At at = rest(i);
        const glm::dvec3 own(test_mesh_.tangents[at.vertex]);
        const paper::Parameters& body = parameters_[at.region];
        return axes_ * chain_.tangent(at.region, at.local,
                                      paper::straightened_tangent(
                                          in_region(at, own), at.local, body.length, body.radius,
                                          {body.rest_angle, body.rest_direction}, body.shape.get()));
    }

    /// A place of region `region`, which counts z from where that begins.
    [[nodiscard]] glm::dvec3 place(std::size_t region, const paper::Cylindrical& rest) const {
        return test_mesh_.cylinder.origin + axes_ * chain_.position(region, rest);
    }

private:
    struct At {
        std::size_t vertex, region;
        paper::Cylindrical local;
    };

    [[nodiscard]] glm::dvec3 in_region(const At& at, const glm::dvec3& vector) const {
        return glm::transpose(rest_.frame(at.region).axes) * (glm::transpose(axes_) * vector);
    }

    [[nodiscard]] At rest(std::size_t i) const {
        At at{};
        at.vertex = binding_.order.empty() ? i : binding_.order[i];
        const std::span<const bend::Region> regions = binding_.body.regions();
        while (i >= regions[at.region].last) ++at.region;
        const paper::Parameters& body = parameters_[at.region];
        const paper::Frame& frame = rest_.frame(at.region);
        const glm::dvec3 point = glm::transpose(axes_) *
                                 (glm::dvec3(test_mesh_.positions[at.vertex]) - test_mesh_.cylinder.origin);
        at.local = paper::to_cylindrical(glm::transpose(frame.axes) * (point - frame.origin), body.length,
                                         body.radius, {body.rest_angle, body.rest_direction});
        if (body.shape && body.rest_angle != 0)
            at.local.z = body.shape->unshifted(at.local.z, body.rest_angle / body.length);
        return at;
    }

    /// Without wrinkles, and straight unless bent.
    static std::vector<paper::Parameters> bare(std::vector<paper::Parameters> bodies) {
        for (paper::Parameters& body : bodies)
            body = {.length = body.length, .radius = body.radius, .shape = body.shape};
        return bodies;
    }

    static std::vector<paper::Pose> rest_poses(const std::vector<paper::Parameters>& bodies) {
        std::vector<paper::Pose> poses;
        for (const paper::Parameters& body : bodies) poses.push_back({body.rest_angle, body.rest_direction});
        return poses;
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
    paper::Chain rest_;  // without wrinkles, as the mesh is
    std::vector<paper::Parameters> parameters_;
    paper::Chain chain_;
};

}  // namespace goffer::test
