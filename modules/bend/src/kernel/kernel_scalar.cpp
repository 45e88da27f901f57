// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/scalar_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_scalar = kernel_set<simd::ScalarLanes, RecordKernels::no>();

}  // namespace goffer::bend
