// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/simd/x86_rows.hpp>
#include <goffer/simd/xsimd_lanes.hpp>

namespace goffer::simd {

/// AVX2 with FMA. Rows of four values come out of registers of eight.
struct Avx2Lanes : XsimdLanes<xsimd::fma3<xsimd::avx2>>, X86Rows<Avx2Lanes> {
    using Single = Avx2Lanes;
    using Row = X86Rows<Avx2Lanes>::Row;
    using X86Rows<Avx2Lanes>::first_of;
    using X86Rows<Avx2Lanes>::mixed_row;
    using X86Rows<Avx2Lanes>::row_times;
    using X86Rows<Avx2Lanes>::store_row;
    using X86Rows<Avx2Lanes>::store_row_first;
    using X86Rows<Avx2Lanes>::store_transposed;

    /// Sets rows[i] to the rows (a, b, c, d) of lanes i, i + 4, i + 8 ..
    static void make_rows(Vec a, Vec b, Vec c, Vec d, Vec (&rows)[4]) {
        const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
        const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
        rows[0] = Vec(_mm256_shuffle_ps(ab_low, cd_low, 0x44));
        rows[1] = Vec(_mm256_shuffle_ps(ab_low, cd_low, 0xee));
        rows[2] = Vec(_mm256_shuffle_ps(ab_high, cd_high, 0x44));
        rows[3] = Vec(_mm256_shuffle_ps(ab_high, cd_high, 0xee));
    }
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        Vec rows[4];
        make_rows(a, b, c, d, rows);
        for (std::size_t i = 0; i < 4; ++i) visit(i, _mm256_castps256_ps128(rows[i]));
        for (std::size_t i = 0; i < 4; ++i) visit(4 + i, _mm256_extractf128_ps(rows[i], 1));
    }
    static Row first_row(Vec a, Vec b, Vec c, Vec d) {
        return first_of(_mm256_castps256_ps128(a), _mm256_castps256_ps128(b), _mm256_castps256_ps128(c),
                        _mm256_castps256_ps128(d));
    }
};

}  // namespace goffer::simd
