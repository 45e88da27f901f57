// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/draw/renderer.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace goffer::cli {

/// The base of a body as lines, bent and wrinkled with it.
class Rig {
public:
    /// Nothing for a body from a body file, which does not say what it was bound to, and where the base lies
    /// outside bend::WorkingRange.
    [[nodiscard]] static std::optional<Rig> make(const BoundModel& model);

    /// Bends it.
    void set(std::span<const bend::Pose> poses);

    /// Its rings and columns.
    [[nodiscard]] std::vector<draw::Mark> lines() const;

private:
    Rig() = default;
    /// Where the vertex of a row and of a column, counted on around the ring, is bent to.
    [[nodiscard]] const glm::vec3& at(std::size_t row, std::size_t column) const;

    bend::Body body_;
    std::vector<std::uint32_t> place_;  // where in the body a vertex of the grid is
    std::size_t rows_ = 0;
    std::vector<glm::vec3> bent_;
};

}  // namespace goffer::cli
