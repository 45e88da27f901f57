// SPDX-License-Identifier: MIT
#include "kernel.hpp"

#include <goffer/simd/xsimd_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_avx2 = kernel_set<simd::XsimdLanes<xsimd::fma3<xsimd::avx2>>>();

}  // namespace goffer::bend
