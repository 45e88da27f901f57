// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/simd/xsimd_lanes.hpp>

#include <immintrin.h>

namespace goffer::simd {

/// AVX-512 with what xsimd 8.1 lacks there: a fused multiply-add (it multiplies, then adds), and estimates of
/// reciprocals (it calls an intrinsic that does not exist). And a part of a batch is stored by a mask.
struct Avx512Lanes : XsimdLanes<xsimd::avx512bw> {
    static Vec madd(Vec a, Vec b, Vec c) { return Vec(_mm512_fmadd_ps(a, b, c)); }
    static Vec nmadd(Vec a, Vec b, Vec c) { return Vec(_mm512_fnmadd_ps(a, b, c)); }
    static Vec rsqrt(Vec a) {
        const Vec y = Vec(_mm512_rsqrt14_ps(a));
        return y * madd(Vec(-0.5f) * a * y, y, Vec(1.5f));
    }
    static Vec reciprocal(Vec a) {
        const Vec y = Vec(_mm512_rcp14_ps(a));
        return y * nmadd(a, y, Vec(2.0f));
    }
    static void store_first(float* to, Vec value, std::size_t count) {
        const auto lanes = static_cast<__mmask16>(count >= width ? 0xffffu : (1u << count) - 1u);
        _mm512_mask_storeu_ps(to, lanes, value);
    }
};

}  // namespace goffer::simd
