// SPDX-License-Identifier: MIT
#pragma once

#include "share.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace goffer::fit {

/// Solves the factors m(alpha, theta), 0 <= m <= 2, of each region, with which the region's triangles keep
/// the area that they have at rest. `body` was made from the same regions without factors; `order` is
/// Binding::order. Runs in the caller's oneTBB arena, from whose threads it tells `share` what is done.
/// Returns the share of the area that is missing all the same in poses that bend the body by up to a right
/// angle, on the mean of all directions; it may be below 0. See modules/paper/README.md, "Amplitude modes".
double solve_factors(const bend::Body& body, const Geometry& geometry, std::span<const std::uint32_t> order,
                     std::span<bend::RegionInput> regions, const Share& share);

/// Solves the factors m(z) of region `region`, 0..1.5, control values at equal steps of its length, with
/// which each of its slices keeps its area in a pose that bends it far, on the mean of several directions.
/// `heights`: z of each of the body's vertices, from its base on. `folds`: those of the region. Empty: the
/// region has no wrinkles. See modules/paper/README.md, "Amplitude modes".
[[nodiscard]] std::vector<double> solve_weights(const bend::Body& body, const Geometry& geometry,
                                                std::span<const std::uint32_t> order,
                                                std::span<const double> heights, std::size_t region,
                                                int folds, const Share& share);

}  // namespace goffer::fit
