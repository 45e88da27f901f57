// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/pose.hpp>
#include <goffer/bend/table.hpp>

#include <array>
#include <cstddef>

/// Regions: stretches of a body's axis, each of which bends along an arc of its own. A region begins in the
/// frame that the end of the one before carries (parallel transport: no twist), and no wrinkle reaches over
/// its ends, so that positions meet.

namespace goffer::bend {

/// Most regions of a body.
inline constexpr std::size_t max_regions = 32;

/// What a region is made from.
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

/// What bounds() needs to know of the vertices in a band of z: one of `count` between the lowest and the
/// highest vertex. Band j is at place j + 1; the places around them are empty.
struct Bands {
    static constexpr std::size_t count = 11;
    static constexpr std::size_t places = 16;
    float lowest = 0;                  ///< v = z / L - 1/2 where the first band begins
    float highest = 0;                 ///< and where the last one ends
    std::array<float, places> rho{};   ///< largest distance from the axis, model units; below 0: no vertex
    std::array<float, places> lift{};  ///< largest g w, at least 0
    std::array<float, places> dip{};   ///< largest -g w, at least 0
};

/// A region of a body: what an instance's set-up reads. A plain value.
struct Region {
    std::size_t first = 0;  ///< its vertices are [first, last)
    std::size_t last = 0;
    float length = 1;
    float per_length = 1;  ///< 1 / length
    float max_angle = 0;   ///< radians
    float onset = 0;
    Pose rest;  ///< the pose that returns the rest mesh
    /// Whether wrinkles follow the squeeze relative to the rest arc, or begin gently: if not, a cheaper
    /// kernel serves.
    bool compares_with_rest = false;
    WrinkleTable table;
    FactorTable factors;
    Bands bands;
};

}  // namespace goffer::bend
