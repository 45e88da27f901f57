// SPDX-License-Identifier: MIT
#pragma once

#include "body/joint.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/body_input.hpp>

#include <cstddef>
#include <span>

/// The parts of Body::check.

namespace goffer::bend {

/// Checks all of `input` but its vertices, and how many of them its regions have.
[[nodiscard]] BodyFault check_rig(const BodyInput& input) noexcept;

/// An upper bound of the depth of the wrinkles of region `r` in any pose, model units, with what its
/// neighbors add to them. `radius`: of the body.
[[nodiscard]] double deepest_wrinkle(std::span<const RegionInput> regions, std::size_t r,
                                     double radius) noexcept;

/// Checks vertex `index`, which is one of `region`; `depth` is the deepest_wrinkle() there.
[[nodiscard]] BodyFault check_vertex(const RestVertex& v, std::size_t index, const RegionInput& region,
                                     double radius, double depth) noexcept;

/// Checks that vertex `index`, if it is near a joint of its region, is not too thick for the region beyond,
/// and that its wrinkle does not pass into that of the other too steeply. `depth`: the deepest_wrinkle() of
/// its region, `joints`: of that region, of which `regions` are the neighbors.
[[nodiscard]] BodyFault check_near_joints(const RestVertex& v, std::size_t index, double length, double depth,
                                          const Joints& joints,
                                          std::span<const RegionInput> regions) noexcept;

/// Checks that a normal or a tangent, which `field` says, is of unit length.
[[nodiscard]] BodyFault check_unit(BodyField field, const RestVector& vector, std::size_t index) noexcept;

}  // namespace goffer::bend
