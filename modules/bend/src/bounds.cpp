// SPDX-License-Identifier: MIT
#include "instance.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/simd/four.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace goffer::bend {
namespace {

using namespace simd;

static_assert(Bands::count == 8, "two Fours of bands, three of their edges");
constexpr std::size_t edges = 12;

/// The centre line at the bands' edges, in the middle frame. (The last three places are beyond.)
struct CentreLine {
    float x[edges], z[edges];          // along n and t
    float cosine[edges], sine[edges];  // of the arc angle
    float step;                        // arc angle of a band
    float length;                      // of a band's piece
};

CentreLine centre_line(const Bands& bands, const Coefficients& k) noexcept {
    CentreLine line;
    const float height = (bands.highest - bands.lowest) / static_cast<float>(Bands::count);
    for (std::size_t j = 0; j < edges; j += 4) {
        const Four place = all(static_cast<float>(j)) + Four{0, 1, 2, 3};
        const Four v = all(bands.lowest) + place * all(height);
        const Four vv = v * v;
        Four rise = all(k.rise[arc_terms - 1]);
        Four reach = all(k.reach[arc_terms - 1]);
        for (std::size_t n = arc_terms - 1; n-- > 0;) {
            rise = rise * vv + all(k.rise[n]);
            reach = reach * vv + all(k.reach[n]);
        }
        rise *= vv;
        reach *= v;
        float curvature = k.first_curvature;
        for (int n = 0; n < k.doublings; ++n, curvature += curvature) {
            const Four cosine = all(1) - all(curvature) * rise;
            rise = all(curvature) * reach * reach;
            reach *= cosine;
        }
        store_four(line.x + j, all(k.one_minus_kappa) * rise);
        store_four(line.z + j, all(k.one_minus_kappa) * reach);
        store_four(line.cosine + j, all(1) - all(k.curvature) * rise);
        store_four(line.sine + j, all(k.curvature) * reach);
    }
    line.length = k.one_minus_kappa * k.reach[0] * height;  // reach[0] is L
    line.step = k.curvature * k.reach[0] * height;
    return line;
}

/// The largest amplitude on the inner and on the outer half of the cross-section. The amplitude grows with
/// the squeeze; sampled all the same, since a caller's table may hold anything.
struct Amplitudes {
    float inner = 0, outer = 0;
};

Amplitudes amplitudes(const Coefficients& k) noexcept {
    constexpr Four t = {0.5f, 1.0f, 1.5f, 2.0f};  // T = 1 + cos(beta - theta)
    Four sum = all(k.amplitude[amplitude_terms - 1]);
    for (std::size_t n = amplitude_terms - 1; n-- > 0;) sum = sum * t + all(k.amplitude[n]);
    const Four amplitude = absolute(sum) * root(t);
    const float outer = std::max(amplitude[0], amplitude[1]);
    return {std::max(outer, std::max(amplitude[2], amplitude[3])), outer};
}

struct Interval {
    float low, high;
};

/// How far bands reach from the centre line.
struct Girth {
    float inner[Bands::count], outer[Bands::count];  // on the bend's side and on the other
};

Girth girth_of(const Bands& bands, const Amplitudes& amplitude) noexcept {
    Girth girth;
    for (std::size_t j = 0; j < Bands::count; j += 4) {
        const Four rho = load_four(&bands.rho[j]), lift = load_four(&bands.lift[j]);
        // A wrinkle deeper than the radius comes out on the other side.
        const Four through = all(amplitude.inner) * load_four(&bands.dip[j]);
        const Four inner = larger(rho + all(amplitude.inner) * lift, through);
        store_four(girth.inner + j, inner);
        store_four(girth.outer + j, through > rho ? inner : rho + all(amplitude.outer) * lift);
    }
    return girth;
}

/// Where the body lies along one axis of the streams' space; (m0, m1, m2) is that axis along n, b, t.
///
/// In a band, the centre line is at most a sagitta beyond its ends. A cross-section reaches (R + A) |(a, b)|
/// beyond the centre line, where (a, b) is the axis within its plane: |(a, b)|^2 = |m|^2 - tau^2 with tau
/// along the centre line. On the far side from the bend (a < 0) the full wrinkle of the inner half counts
/// along b alone.
Interval extent(const Bands& bands, const CentreLine& line, const Girth& girth, float m0, float m1,
                float m2) noexcept {
    const float squares = m0 * m0 + m1 * m1 + m2 * m2;
    float at[edges], a[edges], tau[edges];
    for (std::size_t j = 0; j < edges; j += 4) {
        const Four cosine = load_four(line.cosine + j), sine = load_four(line.sine + j);
        store_four(at + j, all(m0) * load_four(line.x + j) + all(m2) * load_four(line.z + j));
        store_four(a + j, all(m0) * cosine - all(m2) * sine);
        store_four(tau + j, all(m0) * sine + all(m2) * cosine);
    }
    const float sagitta = std::sqrt(m0 * m0 + m2 * m2) * line.length * line.step / 8;
    Four low = all(std::numeric_limits<float>::max());
    Four high = all(std::numeric_limits<float>::lowest());
    for (std::size_t j = 0; j < Bands::count; j += 4) {
        const auto ends = [j](const float* values) {
            return std::pair(load_four(values + j), load_four(values + j + 1));
        };
        const auto [at0, at1] = ends(at);
        const auto [a0, a1] = ends(a);
        const auto [tau0, tau1] = ends(tau);
        const Four steepest = smaller(absolute(tau0), absolute(tau1));
        const Four least = tau0 * tau1 > 0 ? steepest : all(0);
        const Four reach = root(larger(all(0), all(squares) - least * least));
        const Four inner = load_four(girth.inner + j);
        const Four away = larger(load_four(girth.outer + j) * reach, inner * all(std::fabs(m1)));
        const Four up = larger(a0, a1) > 0 ? inner * reach : away;
        const Four down = smaller(a0, a1) < 0 ? inner * reach : away;
        const Four rho = load_four(&bands.rho[j]);  // below 0: no vertex in the band
        low = rho < 0 ? low : smaller(low, smaller(at0, at1) - all(sagitta) - down);
        high = rho < 0 ? high : larger(high, larger(at0, at1) + all(sagitta) + up);
    }
    return {std::min(std::min(low[0], low[1]), std::min(low[2], low[3])),
            std::max(std::max(high[0], high[1]), std::max(high[2], high[3]))};
}

/// The same where a band is bent by more than a quarter turn: the whole circle of the centre line counts.
Interval extent_of_turns(const Girth& girth, const Coefficients& k, float m0, float m1, float m2) noexcept {
    const float largest = *std::max_element(girth.inner, girth.inner + Bands::count);
    const float radius = k.one_minus_kappa / k.curvature;
    const float reach =
        std::sqrt(m0 * m0 + m2 * m2) * radius + largest * std::sqrt(m0 * m0 + m1 * m1 + m2 * m2);
    return {m0 * radius - reach, m0 * radius + reach};
}

}  // namespace

Bounds bounds_of(const Body& body, const Coefficients& k) noexcept {
    const CentreLine line = centre_line(body.bands(), k);
    const Girth girth = girth_of(body.bands(), amplitudes(k));
    Bounds bounds;
    for (int row = 0; row < 3; ++row) {
        const float m0 = k.matrix[row], m1 = k.matrix[4 + row], m2 = k.matrix[8 + row];
        const Interval interval = line.step > 1.5f ? extent_of_turns(girth, k, m0, m1, m2)
                                                   : extent(body.bands(), line, girth, m0, m1, m2);
        const float whole = std::sqrt(m0 * m0 + m1 * m1 + m2 * m2);
        const float margin = 1e-5f * whole * k.reach[0] + 1e-6f * std::fabs(k.offset[row]);
        bounds.low[row] = k.offset[row] + interval.low - margin;
        bounds.high[row] = k.offset[row] + interval.high + margin;
    }
    return bounds;
}

Bounds bounds(const Body& body, const Pose& pose, const glm::mat4x3& transform) noexcept {
    Coefficients k;
    prepare(body, pose, transform, k);
    return bounds_of(body, k);
}

Bounds bounds(const DeformJob& job) noexcept {
    return bounds(*job.body, job.pose, job.transform);
}

void bounds(std::span<const DeformJob> jobs, std::span<Bounds> result) noexcept {
    for (std::size_t i = 0; i < jobs.size(); ++i) result[i] = bounds(jobs[i]);
}

}  // namespace goffer::bend
