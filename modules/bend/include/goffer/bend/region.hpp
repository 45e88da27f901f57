// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/pose.hpp>
#include <goffer/bend/table.hpp>

#include <cstddef>

/// Regions: stretches of a body's axis, each of which bends along an arc of its own. A region begins in the
/// frame that the end of the region before it carries (parallel transport: no twist). At a joint, wrinkles of
/// both regions either vanish or pass into each other, so positions meet there.
/// See modules/paper/README.md, "Regions" and "Folds over joints".

namespace goffer::bend {

/// The most regions that a body can have.
inline constexpr std::size_t max_regions = 32;

/// What a region is made from. WorkingRange limits the numbers further.
struct RegionInput {
    double length = 0;             ///< L > 0 of its outer line, model units
    double max_angle = 0;          ///< radians, > 0, at most (1 + 1e-6) length / (2 radius max_scale)
    double rest_angle = 0;         ///< alpha_0 of its arc at rest, radians, 0..max_angle
    double rest_direction = 0;     ///< theta_0 of its arc at rest, radians
    double onset = 0;              ///< q0, 0..1: see WrinkleRow
    WrinkleTable table = {};       ///< empty: no wrinkles
    FactorTable factors = {};      ///< empty: all factors are 1
    std::size_t vertex_count = 0;  ///< number of the body's vertices that belong to it
    double radius = 0;             ///< r of its base, the mean of its radii, model units; 0: the body's
    double max_scale = 1;          ///< >= 1; no RestVertex::scale of its vertices exceeds it
    /// How far on both sides of the joint with the next region the wrinkles of both pass into each other,
    /// model units; 0: wrinkles vanish at the joint, or there is no next region. Where it is not 0
    /// - it is from 1e-5 of the longer region to what both have room for;
    /// - both regions have a table, and radii within a factor of 1000;
    /// - both or neither have an onset or a rest arc;
    /// - they share a rest arc, or each is bent at rest by WorkingRange::max_joint_rest at most;
    /// - wrinkles pass into each other no more steeply, and with the gain are no deeper, than WorkingRange
    ///   allows;
    /// - among a region's vertices, those near the joint below come before those near the joint above, and
    ///   kernels are fastest if the former come first of all and the latter last;
    /// - none of these is thicker than the other region may be: its scale, times the radius of its region
    ///   over that of the other, is at most 1.01 times the other's max_scale.
    double blend = 0;
    /// The wave g of the next region over that of this one at the joint. Used with a blend, and finite
    /// without.
    double blend_gain = 1;

    [[nodiscard]] bool operator==(const RegionInput&) const = default;
};

/// Whether two regions of a body are straight at rest, or bent along one arc: with curvatures that differ by
/// 1e-6 of the first one's at most, directions that differ by 1e-6 radians, and the same radius. `radius`: of
/// the body, model units. Does not allocate. Thread-safe.
[[nodiscard]] bool share_rest_arc(const RegionInput& a, const RegionInput& b, double radius) noexcept;

/// A region of a body. A plain value.
struct Region {
    std::size_t first = 0;  ///< its vertices are [first, last)
    std::size_t last = 0;
    float length = 1;     ///< L of its outer line, model units
    float max_angle = 0;  ///< largest usable |angle|, radians: beyond it the body would fold through itself
    float onset = 0;      ///< q0: see WrinkleRow
    Pose rest;            ///< the pose that gives the rest shape back
};

}  // namespace goffer::bend
