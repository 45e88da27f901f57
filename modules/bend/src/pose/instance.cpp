// SPDX-License-Identifier: MIT
#include "pose/instance.hpp"

#include "job/streams_wanted.hpp"

#include <goffer/simd/four.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

using namespace simd;

// Polynomials in x = delta^2, first coefficient exact, for delta up to a quarter and up to half of pi. Where
// delta is small, four terms are as good as float; over the whole range they are good enough.
struct ArcTerms {
    float sinc[arc_terms];     // sin(delta) / delta
    float versine[arc_terms];  // (1 - cos(delta)) / delta^2
};
constexpr ArcTerms quarter_terms = {  // within 3.7e-9 and 3.7e-10
    {1.0f, -0.16666654985053148f, 0.008332181044647887f, -0.00019517691414787331f},
    {0.5f, -0.04166665496147368f, 0.0013887734570724405f, -2.4477587586018e-05f}};
constexpr ArcTerms half_terms = {  // within 9.0e-7 and 9.1e-8
    {1.0f, -0.1666594568164659f, 0.00831547072416514f, -0.00018576809626294315f},
    {0.5f, -0.04166593982738049f, 0.0013870900027083285f, -2.3530552718089952e-05f}};

constexpr float pi = std::numbers::pi_v<float>;
static_assert(amplitude_terms == wrinkle_degree + 1);

void set_arc(Coefficients& k, const Region& region, float alpha) noexcept {
    // Beyond a half turn delta leaves the polynomials' range: they then serve a fraction of the angle,
    // doubled back.
    k.doublings = 0;
    float part = alpha;
    for (; part > pi * 1.000001f; part *= 0.5f) ++k.doublings;
    const ArcTerms& terms = part <= pi / 2 ? quarter_terms : half_terms;
    k.first_curvature = part * region.per_length;
    k.curvature = alpha * region.per_length;
    float power = region.length;
    for (std::size_t n = 0; n < arc_terms; ++n) {
        k.reach[n] = power * terms.sinc[n];
        k.rise[n] = power * part * terms.versine[n];
        power *= part * part;
    }
}

/// The sine and cosine of half a direction. A negative angle turns the direction by a half turn, half of
/// which swaps sine and cosine.
struct HalfDirection {
    float sine, cosine;
};

HalfDirection half_direction(const Pose& pose) noexcept {
    const float sine = std::sin(pose.direction / 2);
    const float cosine = std::cos(pose.direction / 2);
    return pose.angle < 0 ? HalfDirection{cosine, -sine} : HalfDirection{sine, cosine};
}

float sine(HalfDirection half) noexcept {
    return 2 * half.sine * half.cosine;
}

float cosine(HalfDirection half) noexcept {
    return (half.cosine - half.sine) * (half.cosine + half.sine);
}

void set_plain_amplitude(Coefficients& k, const WrinkleRow& row, float factor) noexcept {
    for (std::size_t n = 0; n < amplitude_terms; ++n) {
        k.amplitude[n] = factor * row[n];
        k.amplitude_slope[n] = -(0.5f + static_cast<float>(n)) * k.amplitude[n];
    }
}

/// From rows in q / kappa to polynomials in q.
void set_relative_amplitude(Coefficients& k, const WrinkleRow& row, float kappa, float factor) noexcept {
    const float per_kappa = 1 / kappa;
    float scale = factor;
    for (std::size_t n = 0; n < amplitude_terms; ++n) {
        k.amplitude[n] = scale * row[n];
        k.amplitude_slope[n] = (1 + 2 * static_cast<float>(n)) * k.amplitude[n];
        scale *= per_kappa;
    }
}

/// The scale of a column is S = 1 - kappa - curl . u, where u = (cos beta, sin beta) and curl = kappa (cos
/// theta, sin theta). With p = u / S_0, 1 / S_0 = (1 + rest_curl . p) / (1 - kappa_0), which makes q linear
/// in p. The differences vanish exactly at the rest pose.
void set_squeeze(Coefficients& k, const Region& region, float per_kappa_angle, float kappa,
                 HalfDirection half) noexcept {
    const HalfDirection rest_half = half_direction(region.rest);
    const float rest_kappa = region.rest.angle * per_kappa_angle;
    k.cos_direction = cosine(half);
    k.sin_direction = sine(half);
    k.rest_curl[0] = rest_kappa * cosine(rest_half);
    k.rest_curl[1] = rest_kappa * sine(rest_half);
    k.curl_change[0] = kappa * k.cos_direction - k.rest_curl[0];
    k.curl_change[1] = kappa * k.sin_direction - k.rest_curl[1];
    k.squeeze[0] = (kappa - rest_kappa) / (1 - rest_kappa);
    k.squeeze[1] = k.curl_change[0] + k.squeeze[0] * k.rest_curl[0];
    k.squeeze[2] = k.curl_change[1] + k.squeeze[0] * k.rest_curl[1];
    k.onset = std::max(region.onset, 1e-12f);
}

/// The kappa below which a table's row would be scaled by more than float holds.
constexpr float least_kappa = 1e-4f;

void set_wrinkle(Coefficients& k, const Body& body, const Region& region, const Pose& pose, float alpha,
                 HalfDirection half) noexcept {
    const float per_kappa_angle = body.frame().radius * region.per_length;
    const float kappa = alpha * per_kappa_angle;
    float factor = 1;
    if (!region.factors.empty())
        factor =
            region.factors.at(alpha, pose.direction - region.rest.direction + (pose.angle < 0 ? pi : 0.0f));
    if (!region.compares_with_rest) {
        k.wrinkling = Squeeze::plain;
        return set_plain_amplitude(k, region.table.at(alpha), factor * std::sqrt(kappa));
    }
    k.wrinkling = Squeeze::relative;
    set_squeeze(k, region, per_kappa_angle, kappa, half);
    const float row_kappa = std::max(kappa, least_kappa);
    set_relative_amplitude(k, region.table.at(row_kappa / per_kappa_angle), row_kappa, factor);
}

// The middle frame: the arc's point and axes at half height, where the arc has turned by alpha / 2.
struct MiddleFrame {
    Four n, b, t, origin;
};

/// The sine and cosine of a quarter of an arc's angle.
struct Quarter {
    float sine, cosine;
    float sinc;  // sine / angle
};

Quarter quarter_of(float alpha) noexcept {
    const float angle = alpha / 4;
    if (alpha <= pi) {  // the kernels' polynomials, in less than half the time of the library's functions
        const float x = angle * angle;
        const float sinc = polynomial(quarter_terms.sinc, x);
        return {angle * sinc, 1 - x * polynomial(quarter_terms.versine, x), sinc};
    }
    const float sine = std::sin(angle);
    return {sine, std::cos(angle), sine / angle};
}

/// Halves of an arc: its turn, and its chord.
struct HalfArc {
    float sine, cosine;  // of alpha / 2
    float out, up;       // from the base to the middle, towards the bend and along the base's axis
};

HalfArc half_arc(float length, float alpha, float one_minus_kappa) noexcept {
    const Quarter quarter = quarter_of(alpha);
    HalfArc half;
    half.sine = 2 * quarter.sine * quarter.cosine;
    half.cosine = 1 - 2 * quarter.sine * quarter.sine;
    const float arc = one_minus_kappa * length / 2;
    half.out =
        arc * quarter.sine * quarter.sinc;  // arc (1 - cos(alpha / 2)) / (alpha / 2), without cancelling
    half.up = arc * quarter.sinc * quarter.cosine;  // arc sin(alpha / 2) / (alpha / 2)
    return half;
}

MiddleFrame middle_frame(const Joint& joint, const HalfArc& half, float sin_theta, float cos_theta) noexcept {
    const Four e1 = load_four(joint.axes[0]), e2 = load_four(joint.axes[1]), e3 = load_four(joint.axes[2]);
    const Four towards = all(cos_theta) * e1 + all(sin_theta) * e2;
    const Four across = all(cos_theta) * e2 - all(sin_theta) * e1;
    return {all(half.cosine) * towards - all(half.sine) * e3, across,
            all(half.sine) * towards + all(half.cosine) * e3,
            load_four(joint.origin) + all(half.out) * towards + all(half.up) * e3};
}

/// From the middle on to the end, by the same turn and chord once more.
Joint end_of(const MiddleFrame& middle, const HalfArc& half, float sin_theta, float cos_theta) noexcept {
    const Four n = all(half.cosine) * middle.n - all(half.sine) * middle.t;
    const Four t = all(half.sine) * middle.n + all(half.cosine) * middle.t;
    Joint end;
    store_four(end.axes[0], all(cos_theta) * n - all(sin_theta) * middle.b);
    store_four(end.axes[1], all(sin_theta) * n + all(cos_theta) * middle.b);
    store_four(end.axes[2], t);
    store_four(end.origin, middle.origin + all(half.out) * middle.n + all(half.up) * middle.t);
    return end;
}

// Normals go with the cofactors, which are the inverse transpose times the determinant; a determinant below 0
// would turn them inwards. Scaled, since kernels bound squared lengths from below.
void set_normal_matrix(Coefficients& k, Four n, Four b, Four t) noexcept {
    const Four largest = larger(larger(absolute(n), absolute(b)), absolute(t));
    const float size = std::max({largest[0], largest[1], largest[2]});
    if (!(size > 1e-4f && size < 1e4f)) {  // the cofactors' squares would leave float's range
        const Four scale = all(1 / std::max(size, 1e-37f));
        n *= scale, b *= scale, t *= scale;
    }
    const Four cofactors[3] = {cross(b, t), cross(t, n), cross(n, b)};
    k.handedness = sum_three(n * cofactors[0]) < 0 ? -1.0f : 1.0f;
    const float squares =
        sum_three(cofactors[0] * cofactors[0] + cofactors[1] * cofactors[1] + cofactors[2] * cofactors[2]);
    const float scale = squares > 0 ? k.handedness / std::sqrt(squares) : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) store_four(k.normal_matrix + 4 * c, all(scale) * cofactors[c]);
}

void set_matrices(Coefficients& k, const MiddleFrame& frame, const glm::mat4x3& transform) noexcept {
    const Four columns[4] = {load_three(&transform[0][0]), load_three(&transform[1][0]),
                             load_three(&transform[2][0]), load_three(&transform[3][0])};
    const auto linear = [&](Four v) {
        return columns[0] * all(v[0]) + columns[1] * all(v[1]) + columns[2] * all(v[2]);
    };
    const Four n = linear(frame.n), b = linear(frame.b), t = linear(frame.t);
    store_four(k.matrix, n);
    store_four(k.matrix + 4, b);
    store_four(k.matrix + 8, t);
    store_four(k.offset, linear(frame.origin) + columns[3]);
    set_normal_matrix(k, n, b, t);
}

// Positions in steps of the box: what the packed kernel rounds.
void quantise(Coefficients& k, const glm::vec3& low, const glm::vec3& high) noexcept {
    for (int row = 0; row < 3; ++row) {
        const float extent = high[row] - low[row];
        const float scale = extent > 0 ? 65535.0f / extent : 0.0f;
        for (int c = 0; c < 3; ++c) k.matrix[4 * c + row] *= scale;
        k.offset[row] = (k.offset[row] - low[row]) * scale;
    }
}

}  // namespace

void prepare_region(const Posed& posed, std::size_t index, const Joint& from, Coefficients& k,
                    Joint& to) noexcept {
    const Region& region = posed.body->regions()[index];
    const Pose& pose = posed.poses[index];
    const float alpha = std::min(std::fabs(pose.angle), region.max_angle);
    const HalfDirection half = half_direction(pose);
    k.cos_half_direction = half.cosine;
    k.sin_half_direction = half.sine;
    k.one_minus_kappa = 1 - alpha * posed.body->frame().radius * region.per_length;
    k.half_radius = posed.body->frame().radius / 2;
    set_arc(k, region, alpha);
    k.wrinkling = Squeeze::none;
    if (posed.wrinkles && !region.table.empty()) set_wrinkle(k, *posed.body, region, pose, alpha, half);
    const HalfArc arc = half_arc(region.length, alpha, k.one_minus_kappa);
    const float sin_theta = sine(half), cos_theta = cosine(half);
    const MiddleFrame middle = middle_frame(from, arc, sin_theta, cos_theta);
    set_matrices(k, middle, *posed.transform);
    if (index + 1 < posed.body->region_count()) to = end_of(middle, arc, sin_theta, cos_theta);
}

void PreparedPass::advance() noexcept {
    const Joint from = next;
    prepare_region(posed(), ++region, from, coefficients, next);
    if (pass == Pass::packed) quantise(coefficients, low, high);
}

PreparedJob prepare(const DeformJob& job, PreparedPass* passes, bool leave_bounds) noexcept {
    PreparedJob prepared;
    prepared.clamped = is_clamped(*job.body, poses_of(job));
    // Made in place, where a pass begins: coefficients are large for what is done with them here.
    const auto begin = [&](Pass pass) -> PreparedPass& {
        PreparedPass& prepared_pass = passes[prepared.passes];
        prepared_pass.job = &job;
        prepared_pass.pass = pass;
        prepared_pass.region = 0;
        prepare_region(prepared_pass.posed(), 0, job.body->frame().base, prepared_pass.coefficients,
                       prepared_pass.next);
        return prepared_pass;
    };
    if (!job.previous_positions.empty()) {
        begin(Pass::previous);
        ++prepared.passes;
    }
    const bool packed = !job.packed.empty();
    const bool bounded = job.bounds != nullptr && leave_bounds;
    const bool current = streams_wanted(job) != 0;
    if (!current && !packed && !bounded) return prepared;
    const PreparedPass& now = begin(Pass::current);
    if (current) ++prepared.passes;
    if (!packed && !bounded) return prepared;
    const Bounds bounds = bounds_of(now.posed(), now.coefficients, now.next);
    if (bounded) *job.bounds = bounds;
    if (packed) {
        PreparedPass& quantised = passes[prepared.passes++];
        if (&quantised != &now) quantised = now;
        quantised.pass = Pass::packed;
        quantised.low = bounds.low;
        quantised.high = bounds.high;
        quantise(quantised.coefficients, bounds.low, bounds.high);
    }
    return prepared;
}

}  // namespace goffer::bend
