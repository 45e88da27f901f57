// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

namespace goffer::bend {

/// The first fault of a batch, or none; `batch` is not set in it.
[[nodiscard]] Fault check(const Batch& batch) noexcept;

}  // namespace goffer::bend
