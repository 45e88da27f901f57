// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/rest_columns.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/table.hpp>
#include <goffer/engine/columns.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// What a Body holds, for the runtime's own files.

namespace goffer::bend {

/// The frame that a region begins in: axes and origin in float, model space.
struct Frame {
    float axes[3][4];  ///< e1, e2, e3, each followed by a 0
    float origin[4];   ///< center of the cross-section, followed by a 0
};

/// What bounds() needs to know of the vertices in a band of z: one of `count` between the lowest and the
/// highest vertex. Band j is at place j + 1; the places around them are empty.
struct Bands {
    static constexpr std::size_t count = 11;
    static constexpr std::size_t places = 16;
    float lowest = 0;                     ///< v = z / L - 1/2 where the first band begins
    float highest = 0;                    ///< and where the last one ends
    std::array<float, places> rho{};      ///< largest distance from the axis, model units; below 0: no vertex
    std::array<float, places> outward{};  ///< largest g w, at least 0
    std::array<float, places> inward{};   ///< largest -g w, at least 0
};

/// What an instance's set-up reads of a region, beside its Region.
struct RegionData {
    float per_length = 1;  ///< 1 / length
    /// Whether wrinkles follow the squeeze relative to the rest arc, or begin gently: if not, a cheaper
    /// kernel serves.
    bool compares_with_rest = false;
    WrinkleTable table;
    FactorTable factors;
    Bands bands;
};

/// A region's numbers as they were given, before they became float.
struct GivenRegion {
    double length = 0, max_angle = 0, rest_angle = 0, rest_direction = 0, onset = 0;
};

struct BodyData {
    Columns storage;      ///< of `columns`
    RestColumns columns;  ///< padded as Columns says; null where the body has no such column
    std::size_t vertex_count = 0;
    std::vector<Region> regions;
    std::vector<RegionData> details;  ///< one per region
    std::vector<GivenRegion> given;   ///< one per region
    Frame base = {};                  ///< where the first region begins
    float radius_f = 1;               ///< `radius`, rounded
    glm::dvec3 origin{0};
    glm::dmat3 axes{1};
    double length = 0;
    double radius = 0;
};

}  // namespace goffer::bend
