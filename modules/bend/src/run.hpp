// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_args.hpp"

#include <goffer/bend/job.hpp>

#include <cstddef>

namespace goffer::bend {

/// Deforms the vertices [first, last) of a valid job whose coefficients are prepared, on the calling thread.
/// `streaming`: whole lines go past the cache where the streams allow it. Does not allocate.
void run_prepared(const DeformJob& job, const Coefficients& coefficients, std::size_t first, std::size_t last,
                  bool streaming) noexcept;

}  // namespace goffer::bend
