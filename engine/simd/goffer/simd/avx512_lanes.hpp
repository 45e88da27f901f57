// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/simd/xsimd_lanes.hpp>

#include <immintrin.h>

namespace goffer::simd {

/// AVX-512 with what xsimd 8.1 lacks there: a fused multiply-add (it multiplies, then adds), and a reciprocal
/// square root (it calls an intrinsic that does not exist).
struct Avx512Lanes : XsimdLanes<xsimd::avx512bw> {
    static Vec madd(Vec a, Vec b, Vec c) { return Vec(_mm512_fmadd_ps(a, b, c)); }
    static Vec nmadd(Vec a, Vec b, Vec c) { return Vec(_mm512_fnmadd_ps(a, b, c)); }
    static Vec rsqrt(Vec a) {
        const Vec y = Vec(_mm512_rsqrt14_ps(a));
        return y * madd(Vec(-0.5f) * a * y, y, Vec(1.5f));
    }
};

}  // namespace goffer::simd
