// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/job.hpp>

#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Sockets: places on a body that other things are tied to (a hat, a hand, an emitter). They follow the
/// deformation without the mesh being touched, by the same kernels: a socket at a vertex goes where the
/// vertex goes.

namespace goffer::bend {

/// A place on, or in, the rest body, with a frame. Made by fit::socket_at and fit::socket_near, or by hand.
struct Socket {
    std::size_t region = 0;
    RestVertex vertex;               ///< z from where the region begins
    RestVector normal = {1, 0, 0};   ///< unit length: the frame's third axis; outward
    RestVector tangent = {0, 0, 1};  ///< unit length, orthogonal to `normal`: the first axis; toward the tip
};

/// A socket's deformed frame: `axes` are orthonormal and right-handed, the columns being tangent, normal x
/// tangent, and normal.
struct SocketFrame {
    glm::vec3 position{0};
    glm::mat3 axes{1};
};

/// The sockets of a body. Immutable; move-only; share it by reference among instances and threads.
class Sockets {
public:
    /// Sockets of `body`, which is not needed afterward. Nothing where a socket is at fault: its region, or
    /// what Body::check finds of its vertex, normal and tangent. Allocates; may throw std::bad_alloc.
    [[nodiscard]] static std::optional<Sockets> make(const Body& body, std::span<const Socket> sockets);

    [[nodiscard]] std::size_t count() const noexcept { return place_.size(); }

    /// Where the sockets are at `poses` (one per region, finite, clamped as a job's), under `transform`
    /// (model space to the frames' space; a mirroring one gives frames that are right-handed all the same).
    /// frames[i] is of socket i; as many are written as there are sockets, and `frames` must hold them. A
    /// tenth of a microsecond for each region and for some ten sockets. Does not allocate. Thread-safe.
    void frames(std::span<const Pose> poses, std::span<SocketFrame> frames,
                const glm::mat4x3& transform = glm::mat4x3(1)) const noexcept;

    /// The same for a job's current pose, transform and choice of wrinkles. `job` is of the body that the
    /// sockets were made for; its streams are not read.
    void frames(const DeformJob& job, std::span<SocketFrame> frames) const noexcept;

private:
    explicit Sockets(Body body) : body_(std::move(body)) {}

    Body body_;                       // whose vertices are the sockets
    std::vector<std::size_t> place_;  // socket of each vertex
};

}  // namespace goffer::bend
