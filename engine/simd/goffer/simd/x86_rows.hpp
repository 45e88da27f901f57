// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>

#include <cstddef>

namespace goffer::simd {

/// Rows of four values, for lanes whose registers are wider. A template on these lanes, so that each
/// instruction set has functions of its own.
template <class Lanes>
struct X86Rows {
    using Row = __m128;

    /// The row of the first values of a, b, c and d.
    static Row first_of(Row a, Row b, Row c, Row d) {
        return _mm_movelh_ps(_mm_unpacklo_ps(a, b), _mm_unpacklo_ps(c, d));
    }
    static Row mixed_row(const float* from, const float* to, float weight, float factor) {
        const Row low = _mm_loadu_ps(from), high = _mm_loadu_ps(to);
        return _mm_mul_ps(_mm_set1_ps(factor),
                          _mm_add_ps(low, _mm_mul_ps(_mm_set1_ps(weight), _mm_sub_ps(high, low))));
    }
    static Row row_times(Row row, const float* factors) { return _mm_mul_ps(row, _mm_loadu_ps(factors)); }
    /// Stores four rows column by column: the first values of all to to[0], and so on.
    static void store_transposed(const float* const (&rows)[4], float* const (&to)[4]) {
        Row a = _mm_loadu_ps(rows[0]), b = _mm_loadu_ps(rows[1]), c = _mm_loadu_ps(rows[2]),
            d = _mm_loadu_ps(rows[3]);
        _MM_TRANSPOSE4_PS(a, b, c, d);
        _mm_storeu_ps(to[0], a);
        _mm_storeu_ps(to[1], b);
        _mm_storeu_ps(to[2], c);
        _mm_storeu_ps(to[3], d);
    }
    static void store_row(float* to, Row row) { _mm_storeu_ps(to, row); }
    template <std::size_t count>
    static void store_row_first(float* to, Row row) {
        if constexpr (count == 4) {
            _mm_storeu_ps(to, row);
        } else if constexpr (count == 1) {
            _mm_store_ss(to, row);
        } else {
            _mm_storel_pi(reinterpret_cast<__m64*>(to), row);
            if constexpr (count == 3) _mm_store_ss(to + 2, _mm_movehl_ps(row, row));
        }
    }
};

}  // namespace goffer::simd
