// SPDX-License-Identifier: MIT
#pragma once

#include "girths.hpp"
#include "rest.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/fit/bind_options.hpp>
#include <goffer/fit/cylinder.hpp>

#include <span>
#include <vector>

/// What a body is made from, but for what is solved on the body itself.

namespace goffer::fit {

/// A region to be bound, and what its largest angle depends on.
struct Plan {
    const Cylinder& cylinder;
    const BindOptions& options;
    const RestRegion& rest;
    double largest_rho;
    Girths girths;  ///< of a region with a shape
    double scale_beyond;
    double blend_gain;

    /// The largest angle with wrinkles `factor` times as deep. It is never less than the rest arc's: there is
    /// no wrinkle at rest. In bodies that are thousands of radii long it is the largest that a body can have.
    [[nodiscard]] double max_angle(double factor) const;
};

/// All that a body is made from.
struct Draft {
    RestMesh mesh;
    std::vector<Plan> plans;  ///< of the regions
    std::vector<bend::RegionInput> regions;

    /// The base, the options and `places` must stay where they are. `parts`: as rest_mesh() has them.
    Draft(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options, double onset,
          std::span<const RestRegion> places, const Parts* parts);
};

}  // namespace goffer::fit
