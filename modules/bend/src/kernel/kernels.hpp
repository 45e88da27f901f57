// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <goffer/engine/isa.hpp>

namespace goffer::bend {

/// The kernels for `isa`, which runs here (goffer::runs_here). Thread-safe.
[[nodiscard]] const KernelSet& kernels(Isa isa) noexcept;

}  // namespace goffer::bend
