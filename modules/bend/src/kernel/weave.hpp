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

    /// Picks that put plane group `c` into batch `j` of the records, and leave its other lanes as they are.
    template <int c, int j>
    struct Blend {
        static constexpr int at(int lane) {
            return (j * lanes + lane / group) % planes == c ? W + lane : lane;
        }
    };
};

template <class L, int N, int group, int j, int... c>
typename L::Vec records(const typename L::Vec (&spread)[N / group], std::integer_sequence<int, c...>) {
    typename L::Vec result = spread[0];
    using P = Places<static_cast<int>(L::width), N, group>;
    ((result = L::template shuffle<typename P::template Blend<c + 1, j>>(result, spread[c + 1])), ...);
    return result;
}

/// Stores the records of W / group vertices from `from` on, which are N / group batches.
template <class L, int N, int group, int from, int... c>
void spread_and_store(const typename L::Vec (&planes)[N], float* to, bool non_temporal,
                      std::integer_sequence<int, c...>) {
    using P = Places<static_cast<int>(L::width), N, group>;
    const typename L::Vec spread[N / group] = {L::template shuffle<typename P::template Spread<c, from>>(
        planes[c * group], planes[c * group + group - 1])...};
    const typename L::Vec batches[N / group] = {
        records<L, N, group, c>(spread, std::make_integer_sequence<int, N / group - 1>())...};
    for (std::size_t j = 0; j < N / group; ++j) {
        float* at = to + j * L::width;
        non_temporal ? L::stream(at, batches[j]) : L::store(at, batches[j]);
    }
}

/// Stores a register of each plane as records of rows of four.
template <class L, int N>
void store_rows(const typename L::Vec (&planes)[N], float* to, bool non_temporal) {
    typename L::Row rows[N / 4][L::width];
    for (std::size_t g = 0; g < N / 4; ++g) {
        const auto keep = [&](std::size_t i, typename L::Row row) { rows[g][i] = row; };
        L::for_rows(planes[4 * g], planes[4 * g + 1], planes[4 * g + 2], planes[4 * g + 3], keep);
    }
    for (std::size_t i = 0; i < L::width; ++i) {
        for (std::size_t g = 0; g < N / 4; ++g, to += 4)
            non_temporal ? L::stream_row(to, rows[g][i]) : L::store_row(to, rows[g][i]);
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
