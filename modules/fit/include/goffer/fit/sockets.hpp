// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

/// Places sockets on a bound body (offline; may allocate, may throw). bend::Sockets::make takes them.

namespace goffer::fit {

/// The socket at height `z` (0..the body's length, model units, from the base), direction `beta` (radians
/// about the axis, from e1 to e2) and distance `rho` >= 0 from the axis. Its frame at rest: third axis
/// outward, first axis along the body toward the tip. Throws Error where z lies beyond the ends, rho is
/// negative, or one is not finite. Thread-safe.
[[nodiscard]] bend::Socket socket_at(const Binding& binding, double z, double beta, double rho);

/// The socket at the point of the mesh's surface that is nearest to `point` (model space, at rest), with the
/// triangle's normal as third axis and, for the first, the direction in its plane that points to the tip the
/// most. `geometry`: what `bound` was bound from. Looks at every triangle. Throws Error where `point` is not
/// finite, and what check(geometry) throws. Thread-safe.
[[nodiscard]] bend::Socket socket_near(const Binding& binding, const Geometry& geometry,
                                       const glm::dvec3& point);

}  // namespace goffer::fit
