// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"

#include <goffer/simd/float4.hpp>

#include <algorithm>
#include <cmath>

/// What bounds and capsules derive from a region's coefficients: where its center line runs, and how deep its
/// wrinkles are.

namespace goffer::bend {

using simd::Float4;
using simd::splat;

/// Four places of the center line, in the middle frame.
struct CenterLine {
    Float4 x, z;          // along n and t
    Float4 cosine, sine;  // of the arc angle
};

/// The center line at the heights v = z / L - 1/2.
inline CenterLine center_line(const Coefficients& k, Float4 v) noexcept {
    const Float4 vv = v * v;
    Float4 arc_x = polynomial(k.arc_x, vv) * vv;
    Float4 arc_z = polynomial(k.arc_z, vv) * v;
    float curvature = k.first_curvature;
    for (float n = 0; n < k.doublings; ++n, curvature += curvature) {
        const Float4 cosine = splat(1) - splat(curvature) * arc_x;
        arc_x = splat(curvature) * arc_z * arc_z;
        arc_z *= cosine;
    }
    return {splat(k.one_minus_kappa) * arc_x, splat(k.one_minus_kappa) * arc_z,
            splat(1) - splat(k.curvature) * arc_x, splat(k.curvature) * arc_z};
}

/// The columns of a cross-section are divided into sectors from the outer line to the inner one, by T = 1 +
/// cos(beta - theta): 0 to 1/2 to 1 to 3/2 to 2.
constexpr int sectors = 4;

/// The largest amplitude of all columns where the squeeze is relative, with s up to `max_scale`, with which
/// it grows. The maximum of q = (d + e . u) / (1 - kappa_0 - f . u) over unit vectors u is the larger root of
/// |e + q f| = q (1 - kappa_0) - d.
inline float relative_amplitude(const Coefficients& k, float max_scale) noexcept {
    const float e1 = max_scale * k.curl_change[0], e2 = max_scale * k.curl_change[1];
    const float f1 = max_scale * k.rest_curl[0], f2 = max_scale * k.rest_curl[1];
    const float kappa = std::sqrt(f1 * f1 + f2 * f2);
    const float scale = 1 - kappa;
    const float d = max_scale * k.kappa_change;
    const float a = 1 - 2 * kappa;  // of a q^2 - 2 b q - c = 0
    const float b = e1 * f1 + e2 * f2 + scale * d;
    const float c = e1 * e1 + e2 * e2 - d * d;
    const float q = std::max((b + std::sqrt(std::max(b * b + a * c, 0.0f))) / a, 0.0f);
    float largest = 0;
    for (const float part : {0.25f, 0.5f, 0.75f, 1.0f}) {
        const float x = part * q * part * q / (part * q + k.onset);
        largest = std::max(largest, std::fabs(simd::polynomial(k.amplitude, x)) * std::sqrt(x));
    }
    return 1.001f * largest;
}

/// The largest amplitude in each sector and those before it, over sqrt(s) where the squeeze is shaped. It
/// grows with T in tables that fit makes, but a caller's table may hold anything. With a shape, all s up to
/// `max_scale` count, and the polynomial alone falls with s T.
inline Float4 amplitudes(const Coefficients& k, Squeeze squeeze, float max_scale) noexcept {
    if (squeeze == Squeeze::none) return splat(0);
    if (squeeze == Squeeze::relative) return splat(relative_amplitude(k, max_scale));
    const Float4 t = {0.5f, 1.0f, 1.5f, 2.0f};
    Float4 size = abs(polynomial(k.amplitude, t));
    if (squeeze == Squeeze::shaped) {
        for (const float part : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f})
            size = max(size, abs(polynomial(k.amplitude, t * splat(part * max_scale))));
    }
    const Float4 each = size * sqrt(t);
    const float second = std::max(each[0], each[1]), third = std::max(second, each[2]);
    return {each[0], second, third, std::max(third, each[3])};
}

/// The same as amplitudes(), with what the neighbors of region `r` add near joints, where a wrinkle is at
/// most half the neighbor's. `k` and `squeezes` are one per region.
[[nodiscard]] Float4 amplitudes(const BodyData& body, std::size_t r, const Coefficients* k,
                                const Squeeze* squeezes) noexcept;

}  // namespace goffer::bend
