// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

namespace goffer::bend {

/// Finds the first fault of a batch; Fault::batch is not set.
[[nodiscard]] Fault check(const Batch& batch) noexcept;

/// The same without a look at poses, transforms and weights: finds whatever could make a run read or write
/// out of bounds.
[[nodiscard]] Fault check_memory(const Batch& batch) noexcept;

}  // namespace goffer::bend
