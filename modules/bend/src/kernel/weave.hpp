// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <cstddef>
#include <utility>

/// Turns planes into records, in registers: N batches, one of each plane, become N batches of records.
///
/// For odd N, value i of plane c belongs at place N i + c of the records, which is lane (N i + c) mod width
/// of its batch. N and the width have no common factor, so one permutation takes all values of a plane to
/// their lanes, and blending alone then makes each batch of records. For even N the same is done with pairs
/// of planes, 2 c and 2 c + 1. Where N is a multiple of 4, records are rows of four, which a transposition
/// makes.
///
/// Blending N planes to N batches takes N (N - 1) operations. Where N = 3 m, planes c, c + m and c + 2 m have
/// the values of a lane in three batches of different thirds, since N and the width have no common factor.
/// They are blended first, to what each third of the batches takes of them, and then m of these to each
/// batch: N (m + 1) operations.

namespace goffer::bend {

/// Where values of N planes go, for batches of W lanes. `group` is the number of planes that are taken
/// together, 1 or 2.
template <int W, int N, int group>
struct Places {
    static constexpr int planes = N / group;  // groups of planes
    static constexpr int lanes = W / group;   // groups in a batch
    static_assert(group == 1 || lanes == 1 || planes % 2 == 1 || group * 2 == N);

    static constexpr int inverse() {  // the inverse of `planes` modulo `lanes`
        for (int i = 1; i < lanes; ++i) {
            if (planes * i % lanes == 1) return i;
        }
        return 1;
    }

    /// Picks that take plane group `c`, from vertex `from` on, to its lanes. Picks of W and more are of the
    /// second of two planes.
    template <int c, int from>
    struct Spread {
        static constexpr int at(int lane) {
            const int vertex = (lane / group - c % lanes + lanes) * inverse() % lanes;
            return from + vertex + (lane % group) * W;
        }
    };

    static constexpr int ways = planes % 3 == 0 && planes > 3 ? 3 : 1;
    static constexpr int part = planes / ways;

    /// The batch of records that holds the value of plane group `c` in that lane.
    static constexpr int batch_of(int c, int lane) {
        int j = 0;
        while ((j * lanes + lane / group) % planes != c) ++j;
        return j;
    }

    /// Picks that put plane group `c` into the blend for batches of part `p`, and leave its other lanes as
    /// they are.
    template <int c, int p>
    struct BlendForPart {
        static constexpr int at(int lane) { return batch_of(c, lane) / part == p ? W + lane : lane; }
    };

    /// Picks that put the blend of plane groups c, c + part .. into batch `j` of the records, likewise.
    template <int c, int j>
    struct Blend {
        static constexpr int at(int lane) { return (j * lanes + lane / group) % part == c ? W + lane : lane; }
    };
};

/// Blends what the batches of part `p` take of the plane groups c, c + part ..
template <class P, class L, int c, int p, std::size_t planes>
typename L::Vec blend_for_part(const typename L::Vec (&spread)[planes]) {
    typename L::Vec result = spread[c];
    if constexpr (P::ways == 3) {
        constexpr int second = c + P::part, third = second + P::part;
        result = L::template shuffle<typename P::template BlendForPart<second, p>>(result, spread[second]);
        result = L::template shuffle<typename P::template BlendForPart<third, p>>(result, spread[third]);
    }
    return result;
}

/// Makes batch `j` of the records.
template <class P, class L, int j, std::size_t planes, int... c>
typename L::Vec records(const typename L::Vec (&blends)[planes], std::integer_sequence<int, c...>) {
    constexpr int first = j / P::part * P::part;
    typename L::Vec result = blends[first];
    ((result = L::template shuffle<typename P::template Blend<c + 1, j>>(result, blends[first + c + 1])),
     ...);
    return result;
}

template <class L, std::size_t count>
void store_batches(const typename L::Vec (&batches)[count], float* to, bool non_temporal) {
    for (std::size_t j = 0; j < count; ++j, to += L::width)
        non_temporal ? L::stream(to, batches[j]) : L::store(to, batches[j]);
}

/// Stores the records of W / group vertices from `from` on, which are N / group batches.
template <class L, int N, int group, int from, int... c>
void spread_and_store(const typename L::Vec (&planes)[N], float* to, bool non_temporal,
                      std::integer_sequence<int, c...>) {
    using P = Places<static_cast<int>(L::width), N, group>;
    const typename L::Vec spread[N / group] = {L::template shuffle<typename P::template Spread<c, from>>(
        planes[c * group], planes[c * group + group - 1])...};
    const typename L::Vec blends[N / group] = {blend_for_part<P, L, c % P::part, c / P::part>(spread)...};
    const typename L::Vec batches[N / group] = {
        records<P, L, c>(blends, std::make_integer_sequence<int, P::part - 1>())...};
    store_batches<L>(batches, to, non_temporal);
}

/// Picks for registers of W lanes that are taken as rows of four.
template <int W>
struct RowPicks {
    /// Half of the rows of `a`, row `from` and each `step` rows behind it, then the same ones of `b`.
    template <int from, int step>
    struct Rows {
        static constexpr int at(int lane) {
            constexpr int half = W / 8;
            const int row = lane / 4;
            return 4 * (from + row % half * step) + lane % 4 + row / half * W;
        }
    };
};

/// Makes register q of `out` from row q of each of the registers `in`, which are as many as a register has
/// rows.
template <class L>
void transpose_rows(const typename L::Vec* in, typename L::Vec* out) {
    constexpr int W = static_cast<int>(L::width);
    using P = RowPicks<W>;
    if constexpr (W == 4) {
        out[0] = in[0];
    } else if constexpr (W == 8) {
        out[0] = L::template shuffle<typename P::template Rows<0, 1>>(in[0], in[1]);
        out[1] = L::template shuffle<typename P::template Rows<1, 1>>(in[0], in[1]);
    } else {
        static_assert(W == 16);
        using Low = typename P::template Rows<0, 1>;
        using High = typename P::template Rows<2, 1>;
        using Even = typename P::template Rows<0, 2>;
        using Odd = typename P::template Rows<1, 2>;
        const auto low = L::template shuffle<Low>(in[0], in[1]);
        const auto low_too = L::template shuffle<Low>(in[2], in[3]);
        const auto high = L::template shuffle<High>(in[0], in[1]);
        const auto high_too = L::template shuffle<High>(in[2], in[3]);
        out[0] = L::template shuffle<Even>(low, low_too);
        out[1] = L::template shuffle<Odd>(low, low_too);
        out[2] = L::template shuffle<Even>(high, high_too);
        out[3] = L::template shuffle<Odd>(high, high_too);
    }
}

/// Makes records of rows of four from a register of each plane. With R rows in a register, the N / R
/// registers from q N / R on hold the records whose rows are numbers q of their registers.
template <class L, int N>
void make_records(const typename L::Vec (&planes)[N], typename L::Vec (&records)[N]) {
    constexpr std::size_t groups = N / 4, rows_each = L::width / 4, parts = N / rows_each;
    typename L::Vec rows[N];
    for (std::size_t g = 0; g < groups; ++g) {
        typename L::Vec of_group[4];
        const auto* const four = planes + 4 * g;
        L::make_rows(four[0], four[1], four[2], four[3], of_group);
        for (std::size_t i = 0; i < 4; ++i) rows[i * groups + g] = of_group[i];
    }
    for (std::size_t m = 0; m < parts; ++m) {
        typename L::Vec transposed[rows_each];
        transpose_rows<L>(rows + m * rows_each, transposed);
        for (std::size_t q = 0; q < rows_each; ++q) records[q * parts + m] = transposed[q];
    }
}

/// Stores a register of each plane as records of rows of four.
template <class L, int N>
void store_rows(const typename L::Vec (&planes)[N], float* to, bool non_temporal) {
    typename L::Vec records[N];
    make_records<L, N>(planes, records);
    store_batches<L>(records, to, non_temporal);
}

/// The same for records with gaps that keep what they hold: of row g of a record, the first
/// Layout::values_in_row(g) values are stored.
template <class L, int N, class Layout, int g = 0>
void store_rows_between(const typename L::Vec (&planes)[N], float* to) {
    if constexpr (L::width == 16) {
        static_assert(4 % (N / 4) == 0);
        struct Lanes {
            static constexpr bool at(int lane) {
                return lane % 4 < Layout::values_in_row(lane / 4 % (N / 4));
            }
        };
        typename L::Vec records[N];
        make_records<L, N>(planes, records);
        for (std::size_t j = 0; j < N; ++j) L::template store_lanes<Lanes>(to + j * L::width, records[j]);
    } else {
        constexpr int first = 4 * g;
        L::for_rows(planes[first], planes[first + 1], planes[first + 2], planes[first + 3],
                    [&](std::size_t i, typename L::Row row) {
                        L::template store_row_first<Layout::values_in_row(g)>(to + i * N + first, row);
                    });
        if constexpr (first + 4 < N) store_rows_between<L, N, Layout, g + 1>(planes, to);
    }
}

/// Stores a register of each plane as records of N floats.
template <class L, int N>
void store_records(const typename L::Vec (&planes)[N], float* to, bool non_temporal) {
    constexpr int W = static_cast<int>(L::width);
    if constexpr (W == 1) {
        for (int c = 0; c < N; ++c) L::store(to + c, planes[c]);
    } else if constexpr (N % 4 == 0) {
        store_rows<L, N>(planes, to, non_temporal);
    } else if constexpr (N % 2 == 1) {
        spread_and_store<L, N, 1, 0>(planes, to, non_temporal, std::make_integer_sequence<int, N>());
    } else {
        constexpr auto groups = std::make_integer_sequence<int, N / 2>();
        spread_and_store<L, N, 2, 0>(planes, to, non_temporal, groups);
        spread_and_store<L, N, 2, W / 2>(planes, to + N / 2 * L::width, non_temporal, groups);
    }
}

template <class L, int N>
GOFFER_FLATTENED void weave(const float* const* planes, std::size_t lines, float* to, bool non_temporal) {
    const float* from[N];
    for (std::size_t c = 0; c < N; ++c) from[c] = planes[c];
    for (std::size_t i = 0; i < lines * line_floats; i += L::width, to += N * L::width) {
        typename L::Vec batch[N];
        for (std::size_t c = 0; c < N; ++c) batch[c] = L::load(from[c] + i);
        store_records<L, N>(batch, to, non_temporal);
    }
}

}  // namespace goffer::bend
