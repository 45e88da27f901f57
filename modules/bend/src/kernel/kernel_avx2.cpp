// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/doubled_lanes.hpp>
#include <goffer/simd/xsimd_lanes.hpp>

namespace goffer::bend {

using Lanes = simd::XsimdLanes<xsimd::fma3<xsimd::avx2>>;

extern constexpr KernelSet kernels_avx2 = kernel_set<simd::DoubledLanes<Lanes>>();

}  // namespace goffer::bend
