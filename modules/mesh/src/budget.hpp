// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <cstdint>
#include <limits>

namespace goffer::mesh {

/// A mesh that was read, and the one that its Source keeps.
constexpr std::uint64_t kept_copies = 2;

/// A mesh beyond its limits. what() does not name the file: load() puts it in front.
class OverLimit : public Error {
public:
    using Error::Error;
};

/// What is left of the limits while a file is read. To be asked before memory is allocated; throws OverLimit.
class Budget {
public:
    Budget() = default;  ///< for what has been read before: 2^32 - 2 vertices and faces
    explicit Budget(const Limits& limits);

    /// Memory that stays in use. Vectors that grow have up to twice of it.
    void take(std::uint64_t bytes);

    /// Vertices and their memory.
    void take_vertices(std::uint64_t count, std::uint64_t bytes_each);

    /// Faces with that many corners together, their memory, and that of a copy of them.
    void take_faces(std::uint64_t faces, std::uint64_t corners, std::uint64_t bytes_per_corner);

    /// Looks whether all of this would fit, and takes nothing.
    void check(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t bytes) const;

private:
    static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
    /// Meshes number vertices and faces with 32 bits, of which one value means none.
    static constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};

    Limits limits_{.memory = no_limit, .vertices = most, .triangles = most};
    std::uint64_t bytes_ = 0, vertices_ = 0, triangles_ = 0;
};

}  // namespace goffer::mesh
