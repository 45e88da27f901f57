// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/rest_columns.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/table.hpp>
#include <goffer/engine/columns.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// What a Body holds: for goffer's own sources.

namespace goffer::bend {

/// The frame that a region begins in: axes and origin in float, model space.
struct Frame {
    float axes[3][4];  ///< e1, e2, e3, each followed by a 0
    float origin[4];   ///< center of the cross-section, followed by a 0
};

/// What bounds() needs to know of a region's vertices: their extents in each of `count` bands of z, between
/// the lowest and the highest vertex. Band j lies at place j + 1; the places before and behind hold no band.
/// For g, w and S see RestColumns.
struct Bands {
    static constexpr std::size_t count = 11;
    static constexpr std::size_t places = 16;
    float lowest = 0;                     ///< v = z / L - 1/2 where the first band begins
    float highest = 0;                    ///< v where the last band ends
    std::array<float, places> rho{};      ///< largest distance from the axis, model units; below 0: no vertex
    std::array<float, places> outward{};  ///< largest g w S, at least 0
    std::array<float, places> inward{};   ///< largest -g w S, at least 0
};

/// Whether the region is bent at rest or has an onset. If neither, cheaper kernels serve.
[[nodiscard]] inline bool compares_with_rest(const RegionInput& region) noexcept {
    return region.rest_angle != 0 || region.onset != 0;
}

/// What the frame path reads of a region, in addition to Region.
struct RegionData {
    SetupRegion setup = {};                ///< its rows are those of the input's table
    Squeeze squeeze = Squeeze::none;       ///< what makes its wrinkles
    const FactorTable* factors = nullptr;  ///< the input's
    Bands bands;
};

struct BodyData {
    Columns storage;      ///< the memory that `columns` points into
    RestColumns columns;  ///< padded as Columns says; null for columns that the body does not have
    std::size_t vertex_count = 0;
    std::vector<RegionInput> inputs;  ///< what the regions were made from
    std::vector<Region> regions;      ///< one per input
    std::vector<RegionData> details;  ///< one per input
    Frame base = {};                  ///< the frame of the first region
    glm::dvec3 origin{0};
    glm::dmat3 axes{1};
    double length = 0;
    double radius = 0;
};

}  // namespace goffer::bend
