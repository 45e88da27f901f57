// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <utility>

/// From planes to records, in registers: batches of N planes become the same number of batches of records.
///
/// For odd N, value i of plane c belongs at place N i + c of the records, whose lane in its batch is
/// (N i + c) mod width. N and the width have no common factor, so one permutation takes a whole plane to its
/// lanes, and each batch of records takes from each plane by blending alone. For even N the same is done with
/// pairs: (plane 2 c, plane 2 c + 1).

namespace goffer::bend {

/// Values of N planes, `group` planes together (1 or 2), in batches of W lanes.
template <int W, int N, int group>
struct Places {
    static constexpr int planes = N / group;  // as many groups
    static constexpr int lanes = W / group;   // groups in a batch
    static_assert(group == 1 || lanes == 1 || planes % 2 == 1 || group * 2 == N);

    static constexpr int inverse() {  // of `planes`, modulo `lanes`
        for (int i = 1; i < lanes; ++i) {
            if (planes * i % lanes == 1) return i;
        }
        return 1;
    }

    /// Takes plane group `c`, from vertex `from` on, to its lanes. Of two batches: index W and more is the
    /// second one.
    template <int c, int from>
    struct Spread {
        static constexpr int at(int lane) {
            const int vertex = (lane / group - c % lanes + lanes) * inverse() % lanes;
            return from + vertex + (lane % group) * W;
        }
    };

    /// Lanes of batch `j` of the records that come from plane group `c`; the others stay.
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

/// The records of W / group vertices from `from` on: N / group batches.
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

/// One register's planes as so many records of N floats.
template <class L, int N>
void store_records(const typename L::Vec (&planes)[N], float* to, bool non_temporal) {
    constexpr int W = static_cast<int>(L::width);
    if constexpr (W == 1) {
        for (int c = 0; c < N; ++c) L::store(to + c, planes[c]);
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
