// SPDX-License-Identifier: MIT
#pragma once

#include "text.hpp"

#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

/// The mesh as fit_cylinder uses it: a surface in double.

namespace goffer::fit {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline Vector3d eigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline glm::dvec3 from_eigen(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

inline std::string text(const Vector3d& v) {
    return text(v.x()) + "," + text(v.y()) + "," + text(v.z());
}

/// The mesh about its middle and in units of its size, so that nothing cancels or overflows.
struct Body {
    std::vector<Vector3d> points;  // one per vertex
    std::span<const std::uint32_t> triangles;
    Vector3d middle;  // model space
    double size;      // model units: the largest side of the box
};

[[nodiscard]] Body body_of(const Geometry& geometry);

/// The area of its triangles, in units of its size.
[[nodiscard]] double area_of(const Body& body);

/// Centroid and long direction of the surface.
struct Principal {
    Vector3d centroid;
    Vector3d axis;
    double distinct;  // spread along the axis over the spread along the next
};

/// From the exact integrals of 1, x and x x^T over the triangles. Throws Error where all are without area.
[[nodiscard]] Principal principal_axis(const Body& body);

/// Returns `count` small triangles of equal area, spread evenly over the surface and lying in it. To anything
/// that integrates over the surface this is roughly the same body, at a cost that does not depend on the
/// mesh. The indices are kept in `triangles`, which must outlive the result.
[[nodiscard]] Body sampled_surface(const Body& body, std::size_t count,
                                   std::vector<std::uint32_t>& triangles);

}  // namespace goffer::fit
