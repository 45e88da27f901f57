// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/draw/renderer.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace goffer::cli {

/// The base of a body as lines, bent and wrinkled with it, and the frames in which its regions begin and end.
class Rig {
public:
    /// Nothing for a body from a body file, which does not say what it was bound to, and where the base lies
    /// outside bend::WorkingRange.
    [[nodiscard]] static std::optional<Rig> make(const BoundModel& model);

    /// Bends it.
    void set(std::span<const bend::Pose> poses);

    /// Its rings and columns.
    [[nodiscard]] std::vector<draw::Mark> lines() const;
    /// Frame i is where region i begins; one more is where the last ends. Columns e1, e2, e3 and the center.
    [[nodiscard]] std::span<const glm::mat4x3> frames() const { return frames_; }

private:
    Rig() = default;
    /// Where the vertex of a row and of a column, counted on around the ring, is bent to.
    [[nodiscard]] const glm::vec3& at(std::size_t row, std::size_t column) const;

    bend::Body body_;
    std::vector<std::uint32_t> place_;  // where in the body a vertex of the grid is
    std::vector<std::size_t> borders_;  // rows of the grid in which regions begin, and the last
    std::size_t rows_ = 0;
    std::vector<glm::vec3> bent_;
    std::vector<glm::mat4x3> frames_;
};

}  // namespace goffer::cli
