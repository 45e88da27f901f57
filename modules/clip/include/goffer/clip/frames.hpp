// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

/// A moving mesh, frame by frame, for whatever writes it to a file.

namespace goffer::clip {

/// The frames of a clip: one mesh whose vertices move, and which may be carried about as a whole. Frames are
/// made when they are read, so that a clip takes no more memory than the frames that its reader keeps; they
/// may be read in any order and more than once, and are the same bits each time. Not thread-safe.
class Frames {
public:
    virtual ~Frames() = default;

    [[nodiscard]] virtual std::size_t count() const noexcept = 0;  ///< of frames, 1 or more
    [[nodiscard]] virtual double rate() const noexcept = 0;        ///< frames per second, > 0

    /// How many vertices each frame has: the entries of mesh::VertexArrays, of which the first are the
    /// vertices of the mesh, in its order.
    [[nodiscard]] virtual std::size_t vertices() const noexcept = 0;

    /// Writes frame `frame` < count() in model space. `positions` and `normals` have vertices() entries each;
    /// `normals`, of unit length, may be empty where they are not wanted.
    virtual void read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) = 0;

    /// Returns where the mesh is carried in `frame`: a rotation and a shift, from model space to the scene's.
    [[nodiscard]] virtual glm::mat4x3 placement(std::size_t frame) const = 0;
};

}  // namespace goffer::clip
