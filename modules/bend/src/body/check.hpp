// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/body_input.hpp>

#include <cstddef>

/// The parts of Body::check.

namespace goffer::bend {

/// Checks all of `input` but its vertices, and how many of them its regions have.
[[nodiscard]] BodyFault check_rig(const BodyInput& input) noexcept;

/// An upper bound of the depth of a region's wrinkles in any pose, model units. `radius`: of its base.
[[nodiscard]] double deepest_wrinkle(const RegionInput& region, double radius) noexcept;

/// Checks vertex `index`, which is one of `region`; `depth` is the deepest_wrinkle() there.
[[nodiscard]] BodyFault check_vertex(const RestVertex& v, std::size_t index, const RegionInput& region,
                                     double radius, double depth) noexcept;

/// Checks that a normal or a tangent, which `field` says, is of unit length.
[[nodiscard]] BodyFault check_unit(BodyField field, const RestVector& vector, std::size_t index) noexcept;

}  // namespace goffer::bend
