// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/avx2_lanes.hpp>
#include <goffer/simd/doubled_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_avx2 =
    with_small_bodies<simd::Avx2Lanes>(kernel_set<simd::DoubledLanes<simd::Avx2Lanes>>());

}  // namespace goffer::bend
