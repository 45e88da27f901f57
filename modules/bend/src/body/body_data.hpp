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

/// Whether wrinkles follow the squeeze relative to the rest arc, or begin gently; if not, cheaper kernels
/// serve.
[[nodiscard]] inline bool compares_with_rest(const RegionInput& region) noexcept {
    return region.rest_angle != 0 || region.onset != 0;
}

/// What the frame path reads of a region, beside its Region.
struct RegionData {
    SetupRegion setup = {};                ///< its rows are those of the input's table
    Squeeze squeeze = Squeeze::none;       ///< where its wrinkles come from
    const FactorTable* factors = nullptr;  ///< the input's
    Bands bands;
};

struct BodyData {
    Columns storage;      ///< of `columns`
    RestColumns columns;  ///< padded as Columns says; null where the body has no such column
    std::size_t vertex_count = 0;
    std::vector<RegionInput> inputs;  ///< what the regions were made from
    std::vector<Region> regions;      ///< one per input
    std::vector<RegionData> details;  ///< one per input
    Frame base = {};                  ///< where the first region begins
    glm::dvec3 origin{0};
    glm::dmat3 axes{1};
    double length = 0;
    double radius = 0;
};

}  // namespace goffer::bend
