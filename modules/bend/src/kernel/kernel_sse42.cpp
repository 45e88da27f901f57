// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/doubled_lanes.hpp>
#include <goffer/simd/xsimd_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_sse42 =
    kernel_set<simd::DoubledLanes<simd::XsimdLanes<xsimd::sse4_2>>, RecordKernels::no>();

}  // namespace goffer::bend
