// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

/// The last step of set-up: coefficients of the amplitudes, from rows of the wrinkle table, one instance
/// after the other, since each has rows of its own. `L` is lanes of single registers.

namespace goffer::bend {

/// Two neighboring rows of the wrinkle table, and the weight of the second.
struct RowPlace {
    const float *from, *to;
    float weight;
};

template <class L>
RowPlace row_place(const SetupRegion& region, float place) {
    const auto last = static_cast<int>(region.row_count) - 2;
    int low = static_cast<int>(place);
    low = low < last ? low : last;
    return {region.rows[low], region.rows[low + 1], place - static_cast<float>(low)};
}

/// Sets the amplitude's coefficients in T. `factor` includes the root of kappa.
template <class L, class K>
void set_plain_amplitude(const RowPlace& row, float factor, K& k) {
    static constexpr float slopes[amplitude_terms] = {-0.5f, -1.5f, -2.5f, -3.5f, -4.5f, -5.5f, -6.5f, -7.5f};
    for (std::size_t n = 0; n < amplitude_terms; n += 4) {
        const typename L::Row amplitude = L::mixed_row(row.from + n, row.to + n, row.weight, factor);
        L::store_row(k.amplitude + n, amplitude);
        L::store_row(k.amplitude_slope + n, L::row_times(amplitude, slopes + n));
    }
}

/// Sets the amplitude's coefficients in q: the row's, which are in q / kappa, times powers of 1 / kappa.
template <class L, class K>
void set_relative_amplitude(const RowPlace& row, float kappa, float factor, K& k) {
    const float per_kappa = 1 / kappa;
    for (std::size_t n = 0; n < amplitude_terms; ++n, factor *= per_kappa) {
        k.amplitude[n] = factor * (row.from[n] + row.weight * (row.to[n] - row.from[n]));
        k.amplitude_slope[n] = (1 + 2 * static_cast<float>(n)) * k.amplitude[n];
    }
}

template <class L, class K>
void set_no_amplitude(K& k) {
    for (std::size_t n = 0; n < amplitude_terms; ++n) k.amplitude[n] = k.amplitude_slope[n] = 0;
}

template <class L, class K>
void set_amplitude(const SetupRegion& region, float place, float scale, float factor, K& k) {
    const RowPlace row = row_place<L>(region, place);
    if (region.relative) {
        set_relative_amplitude<L>(row, scale, factor, k);
    } else {
        set_plain_amplitude<L>(row, scale * factor, k);
    }
}

/// Sets the amplitudes of setup_width instances side by side. `place`, `scale`, `factor`: one of each.
template <class L>
void set_lane_amplitudes(const SetupRegion& region, bool wrinkled, const float* place, const float* scale,
                         const float* factor, LaneCoefficients& k) {
    struct Amplitudes {
        alignas(64) float amplitude[amplitude_terms];
        float amplitude_slope[amplitude_terms];
    };
    Amplitudes own[setup_width];
    for (std::size_t i = 0; i < setup_width; ++i) {
        if (wrinkled) {
            set_amplitude<L>(region, place[i], scale[i], factor[i], own[i]);
        } else {
            set_no_amplitude<L>(own[i]);
        }
    }
    for (std::size_t i = 0; i < setup_width; i += 4) {
        const auto transpose = [&](auto Amplitudes::*of, InstanceLanes* to) {
            for (std::size_t n = 0; n < amplitude_terms; n += 4)
                L::store_transposed(
                    {own[i].*of + n, own[i + 1].*of + n, own[i + 2].*of + n, own[i + 3].*of + n},
                    {to[n] + i, to[n + 1] + i, to[n + 2] + i, to[n + 3] + i});
        };
        transpose(&Amplitudes::amplitude, k.amplitude);
        transpose(&Amplitudes::amplitude_slope, k.amplitude_slope);
    }
}

}  // namespace goffer::bend
