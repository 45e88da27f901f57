// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/kernel_args.hpp"

#include <goffer/simd/four.hpp>

#include <algorithm>
#include <cmath>

/// What bounds and capsules need to know of a region's coefficients: where its centre line runs, and how deep
/// its wrinkles are.

namespace goffer::bend {

using namespace simd;

/// The centre line at bands' edges, in the middle frame.
struct CentreLine {
    Four x, z;          // along n and t
    Four cosine, sine;  // of the arc angle
};

inline CentreLine centre_line(const Coefficients& k, Four v) noexcept {
    const Four vv = v * v;
    Four rise = polynomial(k.rise, vv) * vv;
    Four reach = polynomial(k.reach, vv) * v;
    float curvature = k.first_curvature;
    for (int n = 0; n < k.doublings; ++n, curvature += curvature) {
        const Four cosine = all(1) - all(curvature) * rise;
        rise = all(curvature) * reach * reach;
        reach *= cosine;
    }
    return {all(k.one_minus_kappa) * rise, all(k.one_minus_kappa) * reach, all(1) - all(k.curvature) * rise,
            all(k.curvature) * reach};
}

/// A cross-section's columns are taken in sectors, from the outer line to the inner one: T = 1 + cos(beta -
/// theta) from 0 to 1/2 to 1 to 3/2 to 2.
constexpr int sectors = 4;

/// The largest amplitude of all columns where the squeeze is relative. q = (d + e . u) / (1 - kappa_0 - f .
/// u) over unit vectors u: its maximum is the larger root of |e + q f| = q (1 - kappa_0) - d.
inline float relative_amplitude(const Coefficients& k) noexcept {
    const float e1 = k.curl_change[0], e2 = k.curl_change[1];
    const float f1 = k.rest_curl[0], f2 = k.rest_curl[1];
    const float kappa = std::sqrt(f1 * f1 + f2 * f2);
    const float scale = 1 - kappa;
    const float d = k.squeeze[0] * scale;
    const float a = 1 - 2 * kappa;  // of a q^2 - 2 b q - c = 0
    const float b = e1 * f1 + e2 * f2 + scale * d;
    const float c = e1 * e1 + e2 * e2 - d * d;
    const float q = std::max((b + std::sqrt(std::max(b * b + a * c, 0.0f))) / a, 0.0f);
    float largest = 0;
    for (const float part : {0.25f, 0.5f, 0.75f, 1.0f}) {
        const float x = part * q * part * q / (part * q + k.onset);
        largest = std::max(largest, std::fabs(polynomial(k.amplitude, x)) * std::sqrt(x));
    }
    return 1.001f * largest;
}

/// The largest amplitude in each sector. It grows with T; the maximum is taken all the same, since a caller's
/// table may hold anything.
inline Four amplitudes(const Coefficients& k) noexcept {
    if (k.wrinkling == Squeeze::none) return all(0);
    if (k.wrinkling == Squeeze::relative) return all(relative_amplitude(k));
    constexpr Four t = {0.5f, 1.0f, 1.5f, 2.0f};
    Four largest = absolute(polynomial(k.amplitude, t)) * root(t);
    for (int i = 1; i < sectors; ++i) largest[i] = std::max(largest[i], largest[i - 1]);
    return largest;
}

}  // namespace goffer::bend
