// SPDX-License-Identifier: MIT
#pragma once

#include "instance.hpp"

#include <cstddef>

namespace goffer::bend {

/// Runs one pass over the vertices [first, last) of a valid job, on the calling thread. `streaming`: whole
/// lines go past the cache where the streams allow it, and the caller fences them. Does not allocate.
void run_pass(const PreparedPass& pass, std::size_t first, std::size_t last, bool streaming) noexcept;

}  // namespace goffer::bend
