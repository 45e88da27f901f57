// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>

#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string_view>

/// Bends a body of several regions along a path: a tentacle along a curve, a fish along its track. The
/// functions do not allocate and are thread-safe.

namespace goffer::bend {

/// What is wrong with a path.
enum class PathFault : std::uint8_t { none, too_few_points, not_finite, repeated_point };

/// Says in one line what is wrong; "no fault" if there is none. Static storage.
[[nodiscard]] std::string_view describe(PathFault fault) noexcept;

/// Finds the first fault of a polyline: fewer than two points, a point that is not finite, or one that
/// repeats the point before it. poses_along() accepts all of these; see there.
[[nodiscard]] PathFault check_path(std::span<const glm::vec3> points) noexcept;

/// Where on a path a body begins, and how it is rolled about its axis there.
struct PathStart {
    /// Length of the path before the base end, in the path's units. Below 0 or not finite, it is taken as 0.
    float distance = 0;
    /// A rotation, from which the body turns the shortest way to the path. That of PathFit::transform in the
    /// frame before keeps a body that walks from rolling; from the same one in all frames, it rolls from
    /// heading to heading. What is no rotation is taken as the identity.
    glm::mat3 before{1};
    /// Then the body rolls so that `model_up`, in model space, points as nearly to `up`, in the path's space,
    /// as its axis lets it: a worm on the ground has its back up. It does not if one of them is zero, not
    /// finite, or along the axis.
    glm::vec3 model_up{0}, up{0};
};

/// How a body lies along a path.
struct PathFit {
    /// From model space to that of the path: a rotation and a shift that put the center of the base end where
    /// the body begins, and the axis along the path there. To lie on the path, an instance takes this as its
    /// job's transform.
    glm::mat4x3 transform{1};
    /// Largest distance from the center line to the part of the path that it runs along, measured at 16
    /// places of each region, in the path's units.
    float error = 0;
    bool clamped = false;  ///< a region should have bent beyond its max_angle, and bends by that instead
};

/// Sets poses[r] to the pose of region r, so that the body's center line runs along the polyline `points`,
/// which has the unit of the body. `poses` is the caller's and should hold one per region; if it is shorter,
/// the remaining regions are ignored; what it has beyond is left alone or set to 0.
///
/// Each region ends in the direction that the path has at that length along it; positions follow from the
/// directions. On a smooth path, the error falls with the square of the regions' lengths. Corners are not
/// rounded, so of long pieces only their directions at the ends of regions count. Beyond its last point the
/// path goes straight on. `body` is not empty. Takes time in proportion to the number of points.
///
/// Points that repeat the point before them are skipped. If all points are the same, the body goes straight
/// on from there, unturned. With fewer than two points, or one that is not finite, all poses are straight,
/// the transform is the identity, and the error is infinite.
PathFit poses_along(const Body& body, std::span<const glm::vec3> points, std::span<Pose> poses,
                    const PathStart& start = {}) noexcept;

/// The same along the cubic Bezier curve of four control points, any of which may be equal. Points nearer to
/// each other than 1e-5 of the control polygon's length count as equal, so that what rounding leaves of a
/// collapsed handle does not turn the body. Directions are those of the curve itself. Takes time in
/// proportion to the number of regions.
PathFit poses_along_bezier(const Body& body, const glm::vec3 (&control)[4], std::span<Pose> poses,
                           const PathStart& start = {}) noexcept;

}  // namespace goffer::bend
