// SPDX-License-Identifier: MIT
#pragma once

#include "figures/figure.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/paper/closed_form.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

/// A tube with a relief, of many numbers of vertices: what is timed.

namespace goffer::cli {

/// A tube of length 10 and radius 1, whose relief is a twentieth of that.
struct Tube {
    static constexpr double length = base_length, radius = base_radius;
    static constexpr int folds = 5;  ///< per half length

    std::vector<paper::Cylindrical> vertices;
    std::vector<std::uint32_t> triangles;

    /// `count` vertices, 100 or more: a number with divisors, so that they make a grid.
    explicit Tube(std::size_t count);

    /// The tube bound as the paper has it, with these folds.
    [[nodiscard]] bend::Body body() const;
};

/// A pose of its own for each frame or instance: back and forth to 120 degrees, in directions that go round.
[[nodiscard]] bend::Pose varied_pose(std::size_t index);

}  // namespace goffer::cli
