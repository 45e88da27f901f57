// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

/// Places sockets on a bound body (offline; may allocate, may throw). bend::Sockets::make takes them.

namespace goffer::fit {

/// Returns the socket at height `z` above the base (0..the cylinder's length, model units, along the rest arc
/// where there is one), direction `beta` (radians about the axis, from e1 toward e2) and distance `rho` from
/// the axis (model units). In its frame at rest the third axis points outward, the first one along the body
/// toward the tip. It follows the wrinkle as the part of the body there does (Binding::parts), without a
/// mask. Throws Error if z is beyond the ends, rho is negative, or one of the three is not finite.
/// Thread-safe.
[[nodiscard]] bend::Socket socket_at(const Binding& binding, double z, double beta, double rho);

/// Returns the socket at the point of the mesh's surface that is nearest to `point` (model space, at rest).
/// The third axis of its frame is the triangle's normal; the first one is the direction in the triangle's
/// plane that points most toward the tip or, on a cap, away from the axis. Triangles without area do not
/// count. `geometry` is the mesh that `binding` was bound from, with its mask; every triangle is looked at.
/// Throws Error if `point` is not finite or no triangle has an area, and as check(geometry) does.
/// Thread-safe.
[[nodiscard]] bend::Socket socket_near(const Binding& binding, const Geometry& geometry,
                                       const glm::dvec3& point);

}  // namespace goffer::fit
