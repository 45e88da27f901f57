// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>

/// A body as vertex attributes, for goffer/gpu/deform.glsl. They are uploaded once and serve all instances;
/// what an instance is comes from goffer::bend::set_up().

namespace goffer::bend {
class Body;
}

namespace goffer::gpu {

/// Where the attributes of a vertex lie in its record, in bytes. Each is of floats, under the name that
/// GofferVertex has for it.
struct VertexLayout {
    /// For an attribute that the body lacks. The shader must then read 0, 0, 0, 1, as OpenGL gives for a
    /// disabled attribute.
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    std::size_t stride = 44;
    std::size_t column = 0;      ///< vec4
    std::size_t wrinkle = 16;    ///< vec4
    std::size_t normal = 32;     ///< vec3
    std::size_t shape = none;    ///< vec4, of a body with a shape, a rest arc or an onset
    std::size_t tangent = none;  ///< vec4, of a body with tangents
    std::size_t joint = none;    ///< vec4, of a body whose folds run on over a joint

    [[nodiscard]] bool operator==(const VertexLayout&) const = default;
};

/// The layout of the records of `body`, which is not empty: 44 to 92 bytes. Thread-safe.
[[nodiscard]] VertexLayout vertex_layout(const bend::Body& body) noexcept;

/// Writes the records of all vertices, in the body's order, without gaps. `result` is the caller's and holds
/// body.vertex_count() * vertex_layout(body).stride bytes or more, 4-byte aligned; it may be a mapped buffer,
/// since nothing is read from it. `body` is not empty. Does not allocate. Thread-safe.
void write_vertices(const bend::Body& body, std::span<std::byte> result) noexcept;

}  // namespace goffer::gpu
