// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string_view>

/// Bending a body of several regions along a path: a tentacle along a curve, a fish along its track.

namespace goffer::bend {

/// What is wrong with a path. describe() says what it should be.
enum class PathFault : std::uint8_t { none, too_few_points, not_finite, repeated_point };

/// One line on `fault`, in static storage. Thread-safe.
[[nodiscard]] std::string_view describe(PathFault fault) noexcept;

/// The first fault of a polyline: fewer than two points, one that is not finite, or one that repeats the one
/// before it. Thread-safe.
[[nodiscard]] PathFault check_path(std::span<const glm::vec3> points) noexcept;

/// How a body lies along a path.
struct PathFit {
    /// From model space to the path's: a rotation and a shift that put the base's center on the first point,
    /// the axis along the path's beginning. The job's transform, if the instance is to lie on the path.
    glm::mat4x3 transform{1};
    /// The largest distance from the center line to the path's part that it runs along, measured at 16 places
    /// of each region, units of the path. A path shorter than the body goes straight on.
    float error = 0;
    bool clamped = false;  ///< a region would have had to bend beyond its max_angle(): it bends so far only
};

/// Poses for the regions of `body`, one each into `poses` (the caller's; of fewer, the first regions get
/// theirs, and the rest of the body is not looked at), such that its center line runs along the polyline
/// `points`. Each region ends in the direction that the path has as far along as the region reaches;
/// positions follow from that. For a smooth path the error falls with the square of the regions' lengths;
/// more of them fit closer. The path's corners are not rounded first: of a path with long pieces only
/// directions at the regions' ends count. Does not allocate. Thread-safe. Time goes with the number of
/// points.
///
/// Points that repeat the one before them are passed over; where all points are one, the body goes straight
/// on from there, unturned. Fewer than two points, or one that is not finite: all poses are straight, the
/// transform is the identity, and the error is infinite.
PathFit poses_along(const Body& body, std::span<const glm::vec3> points, std::span<Pose> poses) noexcept;

/// The same along the cubic Bezier curve of four control points, some of which may be equal; directions are
/// the curve's own. Some 4 microseconds for 16 regions.
PathFit poses_along_bezier(const Body& body, const glm::vec3 (&control)[4], std::span<Pose> poses) noexcept;

}  // namespace goffer::bend
