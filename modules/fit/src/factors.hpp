// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstdint>
#include <span>

namespace goffer::fit {

/// Amplitude mode `mesh` (modules/paper/README.md, "Amplitude modes"):
/// solves each region's factors m(alpha, theta), 0 <= m <= 2, such that
/// the region's own triangles keep the area that they have at rest. `body`: made from the same regions
/// without factors; `order`: as Binding::order. Runs on all processors.
void solve_factors(const bend::Body& body, const Geometry& geometry, std::span<const std::uint32_t> order,
                   std::span<bend::RegionInput> regions);

}  // namespace goffer::fit
