// SPDX-License-Identifier: MIT
#include "instance.hpp"

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

void set_arc(Coefficients& k, const BodyFrame& body, float alpha) noexcept {
    // Beyond a half turn delta leaves the polynomials' range: they then serve a fraction of the angle,
    // doubled back.
    k.doublings = 0;
    float part = alpha;
    for (; part > pi * 1.000001f; part *= 0.5f) ++k.doublings;
    const ArcTerms& terms = part <= pi / 2 ? quarter_terms : half_terms;
    k.first_curvature = part * body.per_length;
    k.curvature = alpha * body.per_length;
    float power = body.length;
    for (std::size_t n = 0; n < arc_terms; ++n) {
        k.reach[n] = power * terms.sinc[n];
        k.rise[n] = power * part * terms.versine[n];
        power *= part * part;
    }
}

void set_amplitude(Coefficients& k, const WrinkleTable& table, float alpha, float kappa) noexcept {
    const WrinkleRow row = table.at(alpha);
    const float root = std::sqrt(kappa);
    for (std::size_t n = 0; n < amplitude_terms; ++n) {
        k.amplitude[n] = root * row[n];
        k.amplitude_slope[n] = -(0.5f + static_cast<float>(n)) * k.amplitude[n];
    }
}

// The middle frame: the arc's point and axes at half height, where the arc has turned by alpha / 2.
struct MiddleFrame {
    Four n, b, t, origin;
};

MiddleFrame middle_frame(const BodyFrame& body, float alpha, float one_minus_kappa, float sin_theta,
                         float cos_theta) noexcept {
    const float quarter = alpha / 4;
    const float sin_quarter = std::sin(quarter);
    const float cos_quarter = std::cos(quarter);
    const float sine = 2 * sin_quarter * cos_quarter;
    const float cosine = 1 - 2 * sin_quarter * sin_quarter;
    const float sinc = quarter > 0 ? sin_quarter / quarter : 1.0f;
    const float arc = one_minus_kappa * body.length / 2;
    const float out = arc * sin_quarter * sinc;  // arc (1 - cos(alpha / 2)) / (alpha / 2), without cancelling
    const float up = arc * sinc * cos_quarter;   // arc sin(alpha / 2) / (alpha / 2)

    const Four e1 = load_four(body.axes[0]), e2 = load_four(body.axes[1]), e3 = load_four(body.axes[2]);
    const Four towards = all(cos_theta) * e1 + all(sin_theta) * e2;
    const Four across = all(cos_theta) * e2 - all(sin_theta) * e1;
    return {all(cosine) * towards - all(sine) * e3, across, all(sine) * towards + all(cosine) * e3,
            load_four(body.origin) + all(out) * towards + all(up) * e3};
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

// Positions in steps of `bounds`: what the packed kernel rounds.
void quantise(Coefficients& k, const Bounds& bounds) noexcept {
    for (int row = 0; row < 3; ++row) {
        const float extent = bounds.high[row] - bounds.low[row];
        const float scale = extent > 0 ? 65535.0f / extent : 0.0f;
        for (int c = 0; c < 3; ++c) k.matrix[4 * c + row] *= scale;
        k.offset[row] = (k.offset[row] - bounds.low[row]) * scale;
    }
}

}  // namespace

bool prepare(const Body& body, const Pose& pose, const glm::mat4x3& transform, Coefficients& k) noexcept {
    const BodyFrame& frame = body.frame();
    const bool clamped = std::fabs(pose.angle) > body.max_angle();
    const float alpha = clamped ? body.max_angle() : std::fabs(pose.angle);
    const float kappa = alpha * frame.radius * frame.per_length;

    // Of half the direction; a negative angle's is turned by a half turn, half of which swaps sine and
    // cosine.
    const float sine = std::sin(pose.direction / 2);
    const float cosine = std::cos(pose.direction / 2);
    k.cos_half_direction = pose.angle < 0 ? -sine : cosine;
    k.sin_half_direction = pose.angle < 0 ? cosine : sine;
    const float ch = k.cos_half_direction, sh = k.sin_half_direction;
    k.one_minus_kappa = 1 - kappa;
    k.half_radius = frame.radius / 2;
    set_arc(k, frame, alpha);
    set_amplitude(k, body.table(), alpha, kappa);
    set_matrices(k, middle_frame(frame, alpha, k.one_minus_kappa, 2 * sh * ch, (ch - sh) * (ch + sh)),
                 transform);
    return clamped;
}

PreparedJob prepare(const DeformJob& job, PreparedPass* passes, bool leave_bounds) noexcept {
    PreparedJob prepared;
    const bool current = !job.positions.empty() || !job.normals.empty() || !job.tangents.empty();
    const bool packed = !job.packed.empty();
    const bool bounded = job.bounds != nullptr && leave_bounds;
    const auto add = [&](Pass pass) -> Coefficients& {
        passes[prepared.passes].job = &job;
        passes[prepared.passes].pass = pass;
        return passes[prepared.passes++].coefficients;
    };
    if (!job.previous_positions.empty()) {
        prepare(*job.body, job.previous_pose, job.previous_transform, add(Pass::previous));
    }
    // Made in place, where a pass begins: coefficients are large for what is done with them here.
    Coefficients& k = passes[prepared.passes].coefficients;
    prepared.clamped = prepare(*job.body, job.pose, job.transform, k);
    if (current) add(Pass::current);
    if (packed || bounded) {
        const Bounds bounds = bounds_of(*job.body, k);
        if (bounded) *job.bounds = bounds;
        if (packed) {
            Coefficients& quantised = add(Pass::packed);
            if (&quantised != &k) quantised = k;
            quantise(quantised, bounds);
        }
    }
    return prepared;
}

}  // namespace goffer::bend
