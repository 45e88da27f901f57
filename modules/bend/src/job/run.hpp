// SPDX-License-Identifier: MIT
#pragma once

#include "pose/instance.hpp"
#include "kernel/kernels.hpp"

#include <cstddef>

namespace goffer::bend {

/// Runs one pass over the vertices [first, last) of a valid job, which lie in the pass's region, on the
/// calling thread. `streaming`: whole lines go past the cache where the streams allow it, and the caller
/// fences them. Does not allocate.
void run_pass(const PreparedPass& pass, std::size_t first, std::size_t last, bool streaming) noexcept;

/// Positions, normals and tangents of `count` vertices of one region from `first` on, by the coefficients
/// `k`, into nine planes (x, y, z of each) that begin `stride` floats apart. The body has tangents.
void run_block(const Body& body, const Coefficients& k, const KernelSet& set, std::size_t first,
               std::size_t count, float* planes, std::size_t stride) noexcept;

}  // namespace goffer::bend
