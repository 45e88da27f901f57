// SPDX-License-Identifier: MIT
#include "kernel/kernel_set.hpp"

#include <goffer/simd/avx512_lanes.hpp>
#include <goffer/simd/doubled_lanes.hpp>

namespace goffer::bend {

extern constexpr KernelSet kernels_avx512 = with_small_bodies<simd::Avx512Lanes>(
    with_pairs<simd::DoubledLanes<simd::Avx512Lanes>>(kernel_set<simd::DoubledLanes<simd::Avx512Lanes>>()));

}  // namespace goffer::bend
