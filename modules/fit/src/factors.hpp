// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstdint>
#include <span>

namespace goffer::fit {

/// Solves the factors m(alpha, theta), 0 <= m <= 2, of each region, with which the region's triangles keep
/// the area that they have at rest. `body` was made from the same regions without factors; `order` is
/// Binding::order. Runs in the caller's oneTBB arena.
/// See modules/paper/README.md, "Amplitude modes".
void solve_factors(const bend::Body& body, const Geometry& geometry, std::span<const std::uint32_t> order,
                   std::span<bend::RegionInput> regions);

}  // namespace goffer::fit
