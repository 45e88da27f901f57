// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/clip/frames.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/vec3.hpp>

#include <span>
#include <vector>

/// How far each frame of a clip is from the mesh at rest.

namespace goffer::clip {

/// A mesh at rest, as the frames see it: a position, and a normal of unit length, for each entry of its
/// vertex arrays. A normal without direction is zero.
struct Rest {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< empty if the mesh has none
    double size = 0;                 ///< largest extent

    double reach = 0;  ///< largest coordinate

    [[nodiscard]] std::size_t entries() const { return positions.size(); }

    /// What floats of this reach may be off by.
    [[nodiscard]] double rounding() const;

    /// What a principal component may have as its value by the rounding of floats alone.
    [[nodiscard]] double noise() const;
};

[[nodiscard]] Rest rest_of(const mesh::Mesh& mesh);

/// Reads frames as displacements from the rest. Refers to both, which must outlive it.
class Moves {
public:
    Moves(const Rest& rest, Frames& frames);

    [[nodiscard]] const Rest& rest() const { return rest_; }
    [[nodiscard]] std::size_t count() const { return frames_.count(); }

    /// Reads `frame`. Throws mesh::Error if it is not finite.
    void read(std::size_t frame, bool with_normals);

    /// Return what the frame that was read last has.
    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }
    [[nodiscard]] const std::vector<glm::vec3>& normals() const { return normals_; }
    [[nodiscard]] glm::dvec3 shift(std::size_t entry) const {
        return glm::dvec3(positions_[entry]) - glm::dvec3(rest_.positions[entry]);
    }
    /// Zero where the rest has no normal.
    [[nodiscard]] glm::dvec3 turn(std::size_t entry) const;
    /// Copies the shifts and turns of all entries; `turns` is empty where there are no normals.
    void copy(std::span<glm::vec3> shifts, std::span<glm::vec3> turns) const;

private:
    const Rest& rest_;
    Frames& frames_;
    std::vector<glm::vec3> positions_, normals_;
};

}  // namespace goffer::clip
