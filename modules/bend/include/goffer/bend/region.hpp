// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/pose.hpp>
#include <goffer/bend/table.hpp>

#include <cstddef>

/// Regions: stretches of a body's axis, each of which bends along an arc of its own. A region begins in the
/// frame that the end of the one before carries (parallel transport: no twist), and no wrinkle reaches over
/// its ends, so that positions meet.
/// See modules/paper/README.md, "Regions".

namespace goffer::bend {

/// Most regions of a body.
inline constexpr std::size_t max_regions = 32;

/// What a region is made from. (WorkingRange says how large and how small numbers may be.)
struct RegionInput {
    double length = 0;          ///< L > 0, of its outer line, model units
    double max_angle = 0;       ///< radians, > 0 and < length / (2 radius) (1 + 1e-6)
    double rest_angle = 0;      ///< alpha_0 of the arc that it is bent along at rest, radians, 0..max_angle
    double rest_direction = 0;  ///< theta_0 of that arc, radians
    double onset = 0;           ///< q0, 0..1: see WrinkleTable
    WrinkleTable table = {};    ///< empty: no wrinkle
    FactorTable factors = {};   ///< empty: 1
    std::size_t vertex_count = 0;  ///< how many of the body's vertices are its own
};

/// A region of a body. A plain value.
struct Region {
    std::size_t first = 0;  ///< its vertices are [first, last)
    std::size_t last = 0;
    float length = 1;  ///< of its outer line, model units
    float max_angle =
        0;            ///< the largest usable |angle|, radians: beyond it the body would fold through itself
    float onset = 0;  ///< q0: see WrinkleTable
    Pose rest;        ///< the pose that returns the rest mesh
};

}  // namespace goffer::bend
