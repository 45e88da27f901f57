// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/simd/x86_rows.hpp>
#include <goffer/simd/xsimd_lanes.hpp>

#include <immintrin.h>

namespace goffer::simd {

/// AVX-512, with what xsimd 8.1 lacks: a fused multiply-add (xsimd multiplies, then adds) and estimates of
/// reciprocals (xsimd calls an intrinsic that does not exist). Masks store parts of a batch.
struct Avx512Lanes : XsimdLanes<xsimd::avx512bw>, X86Rows<Avx512Lanes> {
    using Single = Avx512Lanes;
    using Row = X86Rows<Avx512Lanes>::Row;
    using X86Rows<Avx512Lanes>::first_of;
    using X86Rows<Avx512Lanes>::mixed_row;
    using X86Rows<Avx512Lanes>::row_times;
    using X86Rows<Avx512Lanes>::store_row;
    using X86Rows<Avx512Lanes>::store_row_first;
    using X86Rows<Avx512Lanes>::store_transposed;

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
        if (count == 0) return;  // a store with an empty mask would fetch its line all the same
        const auto lanes = static_cast<__mmask16>(count >= width ? 0xffffu : (1u << count) - 1u);
        _mm512_mask_storeu_ps(to, lanes, value);
    }
    /// Returns the first `count` < width lanes of `a`, and behind them the first ones of `b`.
    static Vec spliced(Vec a, Vec b, std::size_t count) {
        const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        const __m512i from = _mm512_sub_epi32(lanes, _mm512_set1_epi32(static_cast<int>(count)));
        const auto of_b = static_cast<__mmask16>(0xffffu << count);
        return Vec(_mm512_mask_permutexvar_ps(a, of_b, from, b));
    }
    /// Stores the lanes for which Picks::at(lane) is true.
    template <class Picks>
    static void store_lanes(float* to, Vec value) {
        constexpr auto mask = [] {
            unsigned bits = 0;
            for (unsigned lane = 0; lane < width; ++lane)
                if (Picks::at(static_cast<int>(lane))) bits |= 1u << lane;
            return static_cast<__mmask16>(bits);
        }();
        _mm512_mask_storeu_ps(to, mask, value);
    }

    /// Sets rows[i] to the rows (a, b, c, d) of lanes i, i + 4, i + 8 ..
    static void make_rows(Vec a, Vec b, Vec c, Vec d, Vec (&rows)[4]) {
        const __m512 ab_low = _mm512_unpacklo_ps(a, b), ab_high = _mm512_unpackhi_ps(a, b);
        const __m512 cd_low = _mm512_unpacklo_ps(c, d), cd_high = _mm512_unpackhi_ps(c, d);
        rows[0] = Vec(_mm512_shuffle_ps(ab_low, cd_low, 0x44));
        rows[1] = Vec(_mm512_shuffle_ps(ab_low, cd_low, 0xee));
        rows[2] = Vec(_mm512_shuffle_ps(ab_high, cd_high, 0x44));
        rows[3] = Vec(_mm512_shuffle_ps(ab_high, cd_high, 0xee));
    }
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        Vec rows[4];
        make_rows(a, b, c, d, rows);
        for (std::size_t i = 0; i < 4; ++i) visit(i, _mm512_castps512_ps128(rows[i]));
        for (std::size_t i = 0; i < 4; ++i) visit(4 + i, _mm512_extractf32x4_ps(rows[i], 1));
        for (std::size_t i = 0; i < 4; ++i) visit(8 + i, _mm512_extractf32x4_ps(rows[i], 2));
        for (std::size_t i = 0; i < 4; ++i) visit(12 + i, _mm512_extractf32x4_ps(rows[i], 3));
    }
    static Row first_row(Vec a, Vec b, Vec c, Vec d) {
        return first_of(_mm512_castps512_ps128(a), _mm512_castps512_ps128(b), _mm512_castps512_ps128(c),
                        _mm512_castps512_ps128(d));
    }
};

}  // namespace goffer::simd
