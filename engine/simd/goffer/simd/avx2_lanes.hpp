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

    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
        const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
        const __m256 rows[4] = {
            _mm256_shuffle_ps(ab_low, cd_low, 0x44), _mm256_shuffle_ps(ab_low, cd_low, 0xee),
            _mm256_shuffle_ps(ab_high, cd_high, 0x44), _mm256_shuffle_ps(ab_high, cd_high, 0xee)};
        visit_rows(rows, visit);
    }
    static Row first_row(Vec a, Vec b, Vec c, Vec d) {
        return first_of(_mm256_castps256_ps128(a), _mm256_castps256_ps128(b), _mm256_castps256_ps128(c),
                        _mm256_castps256_ps128(d));
    }

private:
    /// Each register of `rows` holds two rows: those of lanes 0 and 4, 1 and 5, 2 and 6, 3 and 7.
    template <class Visit>
    static void visit_rows(const __m256 (&rows)[4], const Visit& visit) {
        for (std::size_t i = 0; i < 4; ++i) visit(i, _mm256_castps256_ps128(rows[i]));
        for (std::size_t i = 0; i < 4; ++i) visit(4 + i, _mm256_extractf128_ps(rows[i], 1));
    }
};

}  // namespace goffer::simd
