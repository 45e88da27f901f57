// SPDX-License-Identifier: MIT
#pragma once

#include "body/joint.hpp"
#include "body/layout.hpp"
#include "kernel/args.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/file_memory.hpp>
#include <goffer/bend/rest_vertex.hpp>
#include <goffer/bend/table.hpp>
#include <goffer/engine/columns.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
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
    /// D / L where bands meet, the edge before band j at place j; between two of them it is off from a
    /// straight line by drift_error at most. 0 without a shape.
    std::array<float, places> drift{};
    float drift_error = 0;
    float max_drift_step = 0;  ///< largest difference between neighbors
    float max_scale = 1;       ///< largest s
    bool shaped = false;       ///< the body has a shape
};

/// The height of a vertex in a region of `length`, as its column has it.
[[nodiscard]] inline float height_of(const RestVertex& v, double length) noexcept {
    return static_cast<float>(v.z / length - 0.5);
}

/// How many bands a step of 1 in v is: 0 where all vertices lie at one height.
[[nodiscard]] inline float bands_per_height(const Bands& bands) noexcept {
    constexpr float least = 1e-18f;  // below it heights were not made from doubles
    const float extent = bands.highest - bands.lowest;
    // Compilers may divide before they compare: not by 0, so that traps may be set.
    return extent > least ? static_cast<float>(Bands::count) / std::max(extent, least) : 0.0f;
}

/// D / L at a place between the edges of bands: j at edge j.
[[nodiscard]] inline float drift_at(const Bands& bands, float place) noexcept {
    const float inside = std::clamp(place, 0.0f, static_cast<float>(Bands::count));
    const auto j = std::min(static_cast<std::size_t>(inside), Bands::count - 1);
    return bands.drift[j] + (inside - static_cast<float>(j)) * (bands.drift[j + 1] - bands.drift[j]);
}

/// Whether the region is bent at rest or has an onset. If neither, cheaper kernels serve.
[[nodiscard]] inline bool compares_with_rest(const RegionInput& region) noexcept {
    return region.rest_angle != 0 || region.onset != 0;
}

/// The radius of a region of a body.
[[nodiscard]] inline double radius_of(const RegionInput& region, double body_radius) noexcept {
    return region.radius == 0 ? body_radius : region.radius;
}

/// What the frame path reads of a region, in addition to Region.
struct RegionData {
    SetupRegion setup = {};                ///< its rows are those of the input's table
    Squeeze squeeze = Squeeze::none;       ///< what makes its wrinkles
    const FactorTable* factors = nullptr;  ///< the input's
    Bands bands;
    Joints joints;
};

struct BodyData {
    Columns storage;      ///< the memory that `columns` points into; empty if it is a file's
    FileMemory memory;    ///< the file's, where the body owns a share of it
    RestColumns columns;  ///< padded as Columns says; null for columns that the body does not have
    ColumnLayout layout;
    std::size_t stride = 0;  ///< floats from one column to the next
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

/// The bands of the vertices [first, last), which are a region's.
[[nodiscard]] Bands bands_of(const RestColumns& columns, std::size_t first, std::size_t last) noexcept;

void set_frame(BodyData& data, const glm::dvec3& origin, const glm::dmat3& axes, double radius) noexcept;

/// Adds the next region, made from `input`, which is the next one of data.inputs. The columns and the frame
/// are there. Its joints know of no vertices.
void add_region(BodyData& data, const RegionInput& input, const Bands& bands);

}  // namespace goffer::bend
