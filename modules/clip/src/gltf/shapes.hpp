// SPDX-License-Identifier: MIT
#pragma once

#include "moves.hpp"

#include <glm/vec3.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

/// Shapes in one piece of memory, for Eigen to work on.

namespace goffer::clip {

/// Displacements from the rest: of all entries' positions and, where the mesh has normals, of these behind.
class Shapes {
public:
    Shapes(const Rest& rest, std::size_t count)
        : entries_(rest.entries()), length_(entries_ + rest.normals.size()), values_(length_ * count) {}

    [[nodiscard]] std::size_t count() const { return values_.size() / length_; }
    [[nodiscard]] std::span<glm::vec3> positions(std::size_t k) {
        return std::span(values_).subspan(k * length_, entries_);
    }
    [[nodiscard]] std::span<const glm::vec3> positions(std::size_t k) const {
        return std::span(values_).subspan(k * length_, entries_);
    }
    /// Empty where the mesh has none.
    [[nodiscard]] std::span<glm::vec3> normals(std::size_t k) {
        return std::span(values_).subspan(k * length_ + entries_, length_ - entries_);
    }
    [[nodiscard]] std::span<const glm::vec3> normals(std::size_t k) const {
        return std::span(values_).subspan(k * length_ + entries_, length_ - entries_);
    }

    /// A column for each shape: three rows for each position, then three for each normal.
    [[nodiscard]] Eigen::Map<Eigen::MatrixXf> matrix() {
        return {&values_[0].x, static_cast<Eigen::Index>(3 * length_), static_cast<Eigen::Index>(count())};
    }
    [[nodiscard]] Eigen::Map<const Eigen::MatrixXf> matrix() const {
        return {&values_[0].x, static_cast<Eigen::Index>(3 * length_), static_cast<Eigen::Index>(count())};
    }

    /// Keeps the first `count` shapes, at most as many as there are.
    void shorten(std::size_t count) { values_.resize(count * length_); }

    /// Takes the first shape out.
    void drop_first() {
        values_.erase(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(length_));
    }

private:
    std::size_t entries_, length_;
    std::vector<glm::vec3> values_;
};

}  // namespace goffer::clip
