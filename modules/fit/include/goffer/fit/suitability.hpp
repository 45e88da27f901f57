// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/bind.hpp>
#include <goffer/fit/bind_options.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstddef>
#include <vector>

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
    /// The direction across that, in radians about the axis, 0..pi. That of a round body may be any.
    double thin_direction = 0;
};

/// Returns the shape of a body about `cylinder`, in its straightened coordinates. Throws Error as
/// check(geometry) and check(cylinder) do. Thread-safe.
[[nodiscard]] Suitability suitability_of(const Geometry& geometry, const Cylinder& cylinder);

/// Why a region has fewer folds than were asked for or, where no number was, than suit it.
enum class FoldShortage {
    /// It has at least half as many folds as suit it. Or none suit it: with profiles other than even, where
    /// it is longer than 2048 radii.
    none,
    /// The mesh's rows of vertices are too far apart, for more than a tenth of the folds that were asked for;
    /// these are made all the same.
    rows,
    /// What BindOptions::wrinkle_range leaves of it is too short for folds, or its rows are too far apart.
    range,
    /// With Profile::even: it is so long that the most folds there may be are too long to wrinkle.
    length,
};

/// Returns why each region of `binding` has too few folds; `options` are those that it was bound with. None
/// with Amplitude::none and where 0 were asked for. Errors as stretches_of(). Thread-safe.
[[nodiscard]] std::vector<FoldShortage> fold_shortages(const Binding& binding, const BindOptions& options);

}  // namespace goffer::fit
