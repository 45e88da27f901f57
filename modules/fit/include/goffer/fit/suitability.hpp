// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstddef>

/// How a body differs from what the method is made for, which is one roughly round thing along one axis.
/// Offline: functions may allocate and throw.

namespace goffer::fit {

/// What suitability_of() found. Shells are parts of the surface that do not touch; one with less than a
/// fiftieth of the area does not count. Vertices in one place are one, so that seams and triangle soups hold
/// together.
struct Suitability {
    std::size_t shells = 0;
    /// How many of the shells lie beside another: at the same heights, over half of the shorter one or more,
    /// and with their middles farther apart than both radii together. One that the axis runs through does
    /// not: what lies beside it is a part of its.
    std::size_t side_by_side = 0;
    double side_by_side_share = 0;  ///< of the area of all shells that count, 0..1
    /// The spread of the sections along the direction in which they spread most, over that across: 1 for
    /// round ones. Each section is taken about its own middle, so that a body may wind.
    double flatness = 1;
};

/// Returns the shape of a body about `cylinder`, in its straightened coordinates. Throws Error as
/// check(geometry) and check(cylinder) do. Thread-safe.
[[nodiscard]] Suitability suitability_of(const Geometry& geometry, const Cylinder& cylinder);

}  // namespace goffer::fit
