// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/fault.hpp>

#include <cstddef>
#include <cstdint>

/// What can be wrong with what a body is to be made from (see goffer/bend/body_input.hpp).

namespace goffer::bend {

/// The part of a BodyInput that is at fault. From `length` to `blend_gain`: a member of a region; from `beta`
/// to `drift`: a member of a vertex.
enum class BodyField : std::uint8_t {
    none,
    origin,
    axes,
    radius,
    regions,  ///< how many there are
    length,
    region_radius,
    max_scale,
    max_angle,
    rest_angle,
    rest_direction,
    onset,
    table,
    factors,
    blend,
    blend_gain,
    vertex_count,  ///< of all regions together
    vertices,      ///< how many there are, or their order: see RegionInput::blend
    beta,
    z,
    rho,
    wrinkle,
    slope,
    scale,
    scale_slope,
    drift,
    normals,
    tangents,
    tangent_signs,
};

/// The first fault of a BodyInput. A plain value; a default-constructed one is none.
struct BodyFault {
    static constexpr std::size_t nowhere = Fault::nowhere;

    BodyField field = BodyField::none;
    Reason reason = Reason::none;
    /// Which region, vertex, normal, tangent or tangent sign. `nowhere`: the body, or all of them.
    std::size_t index = nowhere;

    [[nodiscard]] bool none() const noexcept { return reason == Reason::none; }
    [[nodiscard]] bool operator==(const BodyFault&) const noexcept = default;
};

/// Says in one line what is wrong, where, and what was wanted, as in "regions[2].max_angle: not finite; ...".
/// Returns "no fault" if there is none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const BodyFault& fault) noexcept;

}  // namespace goffer::bend
