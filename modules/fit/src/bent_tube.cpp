// SPDX-License-Identifier: MIT
#include "bent_tube.hpp"

#include "rest.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace goffer::fit {
namespace {

/// The curvature of the rest arc at a height, of the outer line.
double curvature_at(const Cylinder& cylinder, double z) {
    if (cylinder.arcs.empty()) return cylinder.rest_angle / cylinder.length;
    double end = 0;
    for (const RestArc& arc : cylinder.arcs) {
        end += arc.length;
        if (z < end) return arc.angle / arc.length;
    }
    return cylinder.arcs.back().angle / cylinder.arcs.back().length;
}

glm::dvec3 normal_of(const std::array<glm::dvec3, 3>& corners) {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

/// A body in model space, and straightened.
class Straightener {
public:
    Straightener(const Body& body, const Cylinder& cylinder) : cylinder_(cylinder), straightening_(cylinder) {
        for (const Vector3d& point : body.points) {
            bent_.push_back(from_eigen(body.middle + body.size * point));
            straight_.push_back(paper::from_cylindrical(straightening_.vertex(bent_.back())));
        }
    }

    /// Whether an edge lies between the heights of its ends, and not across a gap between two arcs.
    [[nodiscard]] bool leads_along(std::uint32_t a, std::uint32_t b) const {
        const double slack = 1e-9 * cylinder_.length;
        const auto [low, high] = std::minmax(straight_[a].z, straight_[b].z);
        const double middle = straightening_.height((bent_[a] + bent_[b]) / 2.0);
        return middle >= low - slack && middle <= high + slack;
    }

    [[nodiscard]] double area(const std::array<std::uint32_t, 3>& t) const {
        return glm::length(normal_of({bent_[t[0]], bent_[t[1]], bent_[t[2]]}));
    }

    /// The area that the triangle would have if it lay on the axis of the arc: the mean of those that it has
    /// all around the axis.
    [[nodiscard]] double mean_area(const std::array<std::uint32_t, 3>& t) const {
        const std::array corners{straight_[t[0]], straight_[t[1]], straight_[t[2]]};
        const glm::dvec3 normal = normal_of(corners);
        const double z = (corners[0].z + corners[1].z + corners[2].z) / 3;
        const double shrink = 1 - curvature_at(cylinder_, z) * cylinder_.radius;
        return std::hypot(shrink * std::hypot(normal.x, normal.y), normal.z);
    }

private:
    const Cylinder& cylinder_;
    const Straightening straightening_;
    std::vector<glm::dvec3> bent_, straight_;
};

}  // namespace

bool is_bent_tube(const Body& body, const Cylinder& cylinder) {
    constexpr double most_across = 1e-3;  // share of the area
    constexpr double most_aside = 0.035;  // likewise: what lies on one side of the arcs, times how much
                                          // shorter it is there. Tubes have up to 0.007.
    const Straightener straightener(body, cylinder);
    double area = 0, mean = 0, across = 0;
    for (std::size_t i = 0; i + 2 < body.triangles.size(); i += 3) {
        const std::array t{body.triangles[i], body.triangles[i + 1], body.triangles[i + 2]};
        const double own = straightener.area(t);
        area += own;
        mean += straightener.mean_area(t);
        const bool along = straightener.leads_along(t[0], t[1]) && straightener.leads_along(t[1], t[2]) &&
                           straightener.leads_along(t[2], t[0]);
        if (!along) across += own;
    }
    return across <= most_across * area && std::fabs(area / mean - 1) <= most_aside;
}

}  // namespace goffer::fit
