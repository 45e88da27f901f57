// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <goffer/engine/isa.hpp>

namespace goffer::bend {

/// The kernels for `isa`, which must run here (goffer::runs_here). Static storage. Thread-safe.
[[nodiscard]] const KernelSet& kernels(Isa isa) noexcept;

}  // namespace goffer::bend
