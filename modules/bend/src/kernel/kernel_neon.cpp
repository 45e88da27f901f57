// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/xsimd_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_neon = kernel_set<simd::XsimdLanes<xsimd::neon64>>();

}  // namespace goffer::bend
