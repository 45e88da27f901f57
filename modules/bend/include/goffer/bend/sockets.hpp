// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/socket.hpp>

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// Sockets: places on a body that other things are tied to (a hat, a hand, an emitter). They follow the
/// deformation without touching the mesh. The same kernels deform both, so a socket at a vertex goes where
/// the vertex goes.

namespace goffer::bend {

/// The frame of a socket on the deformed body: a matrix whose columns are tangent, normal x tangent, normal
/// (orthonormal and right-handed if the socket's own are orthogonal, unless the transform flattens), and
/// position. It places what is modeled around the origin, z outward.
using SocketFrame = glm::mat4x3;

/// The sockets of a body. Immutable; move-only; instances and threads share it by reference. An object that
/// was moved from may only be destroyed or assigned to.
class Sockets {
public:
    /// Makes the sockets of `body`, which is not needed afterward. Returns nothing if there are no sockets,
    /// if one names a region that the body does not have, or if Body::check finds a fault in its vertex,
    /// normal or tangent. Does not look whether these two are orthogonal. Allocates; may throw
    /// std::bad_alloc.
    [[nodiscard]] static std::optional<Sockets> make(const Body& body, std::span<const Socket> sockets);
    /// The same of those of a body file, for the body of any level. Names are not needed afterward.
    [[nodiscard]] static std::optional<Sockets> make(const Body& body, std::span<const NamedSocket> sockets);

    [[nodiscard]] std::size_t count() const noexcept { return place_.size(); }

    /// Sets frames[i] to the frame of socket i at `poses`, one per region, with full wrinkles, under
    /// `transform` (from model space to the frames' space; frames are right-handed even if it mirrors).
    /// `frames` is the caller's and holds count() or more. Poses may hold any bits: an angle beyond its
    /// region's max_angle is clamped, and poses that are not finite are taken as at rest. Does not allocate.
    /// Thread-safe.
    void frames(std::span<const Pose> poses, std::span<SocketFrame> frames,
                const glm::mat4x3& transform = glm::mat4x3(1)) const noexcept;

    /// The same at a job's current poses, transform, wrinkle_weight and isa. job.body is the body that the
    /// sockets were made for; neither it nor the outputs are read.
    void frames(const DeformJob& job, std::span<SocketFrame> frames) const noexcept;

private:
    explicit Sockets(Body body) : body_(std::move(body)) {}

    Body body_;                       // its vertices are the sockets, sorted by region
    std::vector<std::size_t> place_;  // the socket that each vertex is
};

}  // namespace goffer::bend
