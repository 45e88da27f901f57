// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/amplitude_rows.hpp"
#include "kernel/args.hpp"
#include "kernel/direction.hpp"
#include "kernel/setup_result.hpp"
#include "kernel/sin_cos.hpp"
#include "kernel/vector3.hpp"

/// Set-up, for as many instances at a time as a register has lanes. The result of a lane depends on that lane
/// alone, so an instance gets the same bits whatever its neighbors. `L` is lanes of single registers.

namespace goffer::bend {

/// Polynomials in x = delta^2 with an exact first coefficient. quarter_terms serve delta up to pi / 4, where
/// four terms are as accurate as float; half_terms serve delta up to pi / 2. The numbers beside them are the
/// largest errors.
struct ArcTerms {
    float sinc[arc_terms];     // sin(delta) / delta
    float versine[arc_terms];  // (1 - cos(delta)) / delta^2
};
constexpr ArcTerms quarter_terms = {  // 3.7e-9 and 3.7e-10
    {1.0f, -0.16666654985053148f, 0.008332181044647887f, -0.00019517691414787331f},
    {0.5f, -0.04166665496147368f, 0.0013887734570724405f, -2.4477587586018e-05f}};
constexpr ArcTerms half_terms = {  // 9.0e-7 and 9.1e-8
    {1.0f, -0.1666594568164659f, 0.00831547072416514f, -0.00018576809626294315f},
    {0.5f, -0.04166593982738049f, 0.0013870900027083285f, -2.3530552718089952e-05f}};

constexpr float half_turn = 3.14159265f;

template <class L>
typename L::Vec horner(const float (&terms)[arc_terms], typename L::Vec x) {
    typename L::Vec sum = L::splat(terms[arc_terms - 1]);
    for (std::size_t n = arc_terms - 1; n-- > 0;) sum = L::madd(sum, x, L::splat(terms[n]));
    return sum;
}

/// Angles and directions of less than these, in radians, are taken as 0. What decays comes to numbers that
/// are subnormal, or have products that are (of a direction, the fourth power), and with those processors
/// compute up to fifty times as long.
constexpr float tiny_angle = 1e-12f, tiny_direction = 1e-8f;

template <class L>
typename L::Vec without_tiny(typename L::Vec angle, float tiny) {
    return L::where_less(L::abs(angle), L::splat(tiny), L::splat(0.0f), angle);
}

/// Sine and cosine of twice the angle.
template <class L>
SinCos<L> doubled(SinCos<L> of) {
    const typename L::Vec twice = of.sine + of.sine;
    return {twice * of.cosine, L::nmadd(twice, of.sine, L::splat(1.0f))};
}

/// Sine and cosine of an angle within -pi / 4..pi / 4.
template <class L>
SinCos<L> sin_cos(typename L::Vec angle) {
    const typename L::Vec x = angle * angle;
    return {angle * horner<L>(quarter_terms.sinc, x),
            L::nmadd(x, horner<L>(quarter_terms.versine, x), L::splat(1.0f))};
}

/// Sets up the instances in one register.
template <class L, class Result>
class SetupLanes {
public:
    using Vec = typename L::Vec;

    SetupLanes(const SetupRegion& region, SetupColumns& columns, std::size_t first, bool normals,
               const Result& result)
        : region_(region), columns_(columns), first_(first), normals_(normals), result_(result) {}

    /// Sets everything but the amplitudes. For these it leaves, for each instance, the place of its row in
    /// the table and the scale that set_plain_amplitude or set_relative_amplitude takes.
    void run(float* table_place, float* scale) {
        const Vec angle = L::load(columns_.angle + first_);
        alpha_ = without_tiny<L>(L::min(L::abs(angle), L::splat(region_.max_angle)), tiny_angle);
        set_direction(angle);
        curvature_ = alpha_ * L::splat(region_.per_length);
        const Vec kappa = curvature_ * L::splat(region_.radius);
        one_minus_kappa_ = L::splat(1.0f) - kappa;
        put([](auto& k) { return &k.cos_half_direction; }, half_.cosine, half_.sine, one_minus_kappa_,
            curvature_);
        set_arc();
        set_frames();
        if (region_.relative) set_squeeze(kappa);
        if (region_.rows != nullptr) find_row(kappa, table_place, scale);
    }

private:
    template <class Row>
    void put(const Row& row, Vec a, Vec b, Vec c, Vec d) const {
        result_.put(row, a, b, c, d);
    }

    /// Rows stand at equal steps of the angle's root. Below min_kappa, the scale of a relative row would
    /// leave float's range.
    void find_row(Vec kappa, float* table_place, float* scale) const {
        Vec angle = alpha_;
        if (region_.relative) {
            constexpr float min_kappa = 1e-4f;
            kappa = L::max(kappa, L::splat(min_kappa));
            angle = kappa * L::splat(1 / (region_.per_length * region_.radius));
        }
        L::store(scale, region_.relative ? kappa : L::sqrt(kappa));
        const Vec fraction =
            L::clamp(angle * L::splat(1 / region_.table_max_angle), L::splat(0.0f), L::splat(1.0f));
        L::store(table_place, L::sqrt(fraction) * L::splat(static_cast<float>(region_.row_count - 1)));
    }

    static SinCos<L> half_of(Vec direction) {
        const Vec wrapped = without_tiny<L>(wrapped_direction<L>(direction), tiny_direction);
        return doubled<L>(sin_cos<L>(wrapped * L::splat(0.25f)));
    }
    static SinCos<L> whole_of(SinCos<L> half) {
        return {(half.sine + half.sine) * half.cosine, (half.cosine - half.sine) * (half.cosine + half.sine)};
    }

    /// A negative angle turns the direction by pi, and half the direction by pi / 2, which swaps sine and
    /// cosine.
    void set_direction(Vec angle) {
        const SinCos<L> half = half_of(L::load(columns_.direction + first_));
        const Vec zero = L::splat(0.0f);
        half_.sine = L::where_less(angle, zero, half.cosine, half.sine);
        half_.cosine = L::where_less(angle, zero, zero - half.sine, half.cosine);
        whole_ = whole_of(half_);
    }

    /// Beyond a half turn, delta leaves the range of the polynomials. They then serve alpha / 2^doublings,
    /// and the double-angle formulas lead back.
    void set_arc() {
        const Vec limit = L::splat(half_turn * 1.000001f), zero = L::splat(0.0f), one = L::splat(1.0f);
        part_ = alpha_;
        doublings_ = zero;
        for (float halved = region_.max_angle; halved > half_turn * 1.000001f; halved *= 0.5f) {
            doublings_ = doublings_ + L::where_less(limit, part_, one, zero);
            part_ = L::where_less(limit, part_, part_ * L::splat(0.5f), part_);
        }
        // Below this, terms beyond the first are less than they are rounded to, and might become subnormal.
        const Vec least = L::splat(1e-8f);
        Vec square = part_ * part_;
        square = L::where_less(square, least, zero, square);
        Vec power = L::splat(region_.length);
        Vec arc_z[arc_terms], arc_x[arc_terms];
        const Vec quarter = L::splat(half_turn / 2);
        for (std::size_t n = 0; n < arc_terms; ++n) {
            const auto term = [&](float large, float small) {
                return L::where_less(quarter, part_, L::splat(large), L::splat(small));
            };
            arc_z[n] = power * term(half_terms.sinc[n], quarter_terms.sinc[n]);
            arc_x[n] = power * part_ * term(half_terms.versine[n], quarter_terms.versine[n]);
            power = power * square;
        }
        put([](auto& k) { return &k.arc_z[0]; }, arc_z[0], arc_z[1], arc_z[2], arc_z[3]);
        put([](auto& k) { return &k.arc_x[0]; }, arc_x[0], arc_x[1], arc_x[2], arc_x[3]);
    }

    [[nodiscard]] Vector3<L> frame(std::size_t from) const {
        return {L::load(columns_.frame[from] + first_), L::load(columns_.frame[from + 1] + first_),
                L::load(columns_.frame[from + 2] + first_)};
    }

    void set_frame(std::size_t to, const Vector3<L>& v) {
        L::store(columns_.frame[to] + first_, v.x);
        L::store(columns_.frame[to + 1] + first_, v.y);
        L::store(columns_.frame[to + 2] + first_, v.z);
    }

    /// Half of the arc: its turn and its chord.
    struct HalfArc {
        Vec sine, cosine;  // of alpha / 2
        Vec out, up;       // chord from the base to the middle: toward the bend, and along the base's axis
    };

    [[nodiscard]] HalfArc half_arc() const {
        const Vec x = L::splat(0.25f) * part_;
        const SinCos<L> quarter = sin_cos<L>(x);
        const Vec sinc = horner<L>(quarter_terms.sinc, x * x);
        SinCos<L> half = doubled<L>(quarter);
        const Vec arc = one_minus_kappa_ * L::splat(0.5f * region_.length);
        // arc (1 - cos(alpha / 2)) / (alpha / 2) and arc sin(alpha / 2) / (alpha / 2), without cancellation
        HalfArc result{half.sine, half.cosine, arc * quarter.sine * sinc, arc * sinc * quarter.cosine};
        Vec left = doublings_;
        const Vec zero = L::splat(0.0f), one = L::splat(1.0f);
        for (float halved = region_.max_angle; halved > half_turn * 1.000001f; halved *= 0.5f) {
            const SinCos<L> twice = doubled<L>({result.sine, result.cosine});
            result.sine = L::where_less(zero, left, twice.sine, result.sine);
            result.cosine = L::where_less(zero, left, twice.cosine, result.cosine);
            left = left - one;
        }
        if (region_.max_angle > half_turn) {
            const Vec chord = one_minus_kappa_ * L::splat(region_.length) / L::max(alpha_, one);
            result.out = L::where_less(zero, doublings_, chord * (one - result.cosine), result.out);
            result.up = L::where_less(zero, doublings_, chord * result.sine, result.up);
        }
        return result;
    }

    /// Sets the middle frame, which is point and axes of the arc at half height, where it has turned by alpha
    /// / 2. The same turn and chord once more lead to the frame at the end.
    void set_frames() {
        const HalfArc half = half_arc();
        const Vec zero = L::splat(0.0f);
        const Vector3<L> e1 = frame(0), e2 = frame(3), e3 = frame(6);
        const Vector3<L> toward = combined(whole_.cosine, e1, whole_.sine, e2);
        const Vector3<L> b = combined(whole_.cosine, e2, zero - whole_.sine, e1);
        const Vector3<L> n = combined(half.cosine, toward, zero - half.sine, e3);
        const Vector3<L> t = combined(half.sine, toward, half.cosine, e3);
        const Vector3<L> origin = sum(frame(9), combined(half.out, toward, half.up, e3));
        set_matrices(n, b, t, origin);
        if (region_.last) return;
        const Vector3<L> end_n = combined(half.cosine, n, zero - half.sine, t);
        set_frame(0, combined(whole_.cosine, end_n, zero - whole_.sine, b));
        set_frame(3, combined(whole_.sine, end_n, whole_.cosine, b));
        set_frame(6, combined(half.sine, n, half.cosine, t));
        set_frame(9, sum(origin, combined(half.out, n, half.up, t)));
    }

    [[nodiscard]] Vector3<L> linear(const Vector3<L>& v) const {
        const auto row = [&](std::size_t r) {
            return L::madd(L::load(columns_.transform[r] + first_), v.x,
                           L::madd(L::load(columns_.transform[3 + r] + first_), v.y,
                                   L::load(columns_.transform[6 + r] + first_) * v.z));
        };
        return {row(0), row(1), row(2)};
    }

    void set_matrices(const Vector3<L>& frame_n, const Vector3<L>& frame_b, const Vector3<L>& frame_t,
                      const Vector3<L>& frame_origin) {
        const Vec zero = L::splat(0.0f);
        const Vector3<L> shift = {L::load(columns_.transform[9] + first_),
                                  L::load(columns_.transform[10] + first_),
                                  L::load(columns_.transform[11] + first_)};
        const Vector3<L> n = linear(frame_n), b = linear(frame_b), t = linear(frame_t);
        const Vector3<L> origin = sum(linear(frame_origin), shift);
        put([](auto& k) { return &k.matrix[0]; }, n.x, n.y, n.z, zero);
        put([](auto& k) { return &k.matrix[4]; }, b.x, b.y, b.z, zero);
        put([](auto& k) { return &k.matrix[8]; }, t.x, t.y, t.z, zero);
        put([](auto& k) { return &k.offset[0]; }, origin.x, origin.y, origin.z, zero);
        const Vec handedness = normals_ ? set_normal_matrix(n, b, t) : L::splat(1.0f);
        put([](auto& k) { return &k.first_curvature; }, part_ * L::splat(region_.per_length), doublings_,
            L::splat(region_.radius * 0.5f), handedness);
    }

    // Normals are transformed by the cofactors: the inverse transpose times the determinant, which turns them
    // inward if it is negative. The result is scaled, since kernels add a small number to squared lengths.
    // The matrix is scaled first if squares of its cofactors would leave float's range. Returns the sign of
    // the determinant.
    Vec set_normal_matrix(Vector3<L> n, Vector3<L> b, Vector3<L> t) {
        const Vec zero = L::splat(0.0f), one = L::splat(1.0f);
        const Vec size = L::max(L::max(largest(n), largest(b)), largest(t));
        const Vec inverse = one / L::max(size, L::splat(1e-37f));
        const Vec scale =
            L::where_less(L::splat(1e-4f), size, L::where_less(size, L::splat(1e4f), one, inverse), inverse);
        n = scaled(scale, n), b = scaled(scale, b), t = scaled(scale, t);
        const Vector3<L> cofactors[3] = {cross(b, t), cross(t, n), cross(n, b)};
        const Vec handedness = L::where_less(dot(n, cofactors[0]), zero, L::splat(-1.0f), one);
        Vec squares = dot(cofactors[0], cofactors[0]);
        squares = squares + dot(cofactors[1], cofactors[1]) + dot(cofactors[2], cofactors[2]);
        const Vec to_unit =
            L::where_less(zero, squares, handedness / L::sqrt(L::max(squares, L::splat(1e-37f))), zero);
        const auto put_column = [&](const auto& row, const Vector3<L>& v) {
            put(row, to_unit * v.x, to_unit * v.y, to_unit * v.z, zero);
        };
        put_column([](auto& k) { return &k.normal_matrix[0]; }, cofactors[0]);
        put_column([](auto& k) { return &k.normal_matrix[4]; }, cofactors[1]);
        put_column([](auto& k) { return &k.normal_matrix[8]; }, cofactors[2]);
        return handedness;
    }

    /// A column has the scale S = 1 - s (kappa + curl . u), where u = (cos beta, sin beta) and curl = kappa
    /// (cos theta, sin theta), so that q is linear in s / S_0 and s u / S_0. The differences vanish exactly
    /// at the rest pose. See modules/paper/README.md, "Bodies bent at rest".
    void set_squeeze(Vec kappa) {
        // The same operations as for the pose, so that they cancel exactly.
        const Vec rest_kappa =
            L::splat(region_.rest_angle) * L::splat(region_.per_length) * L::splat(region_.radius);
        const SinCos<L> rest = whole_of(half_of(L::splat(region_.rest_direction)));
        const Vec rest_cosine = rest_kappa * rest.cosine, rest_sine = rest_kappa * rest.sine;
        const Vec change_cosine = kappa * whole_.cosine - rest_cosine;
        const Vec change_sine = kappa * whole_.sine - rest_sine;
        put([](auto& k) { return &k.cos_direction; }, whole_.cosine, whole_.sine, rest_cosine, rest_sine);
        put([](auto& k) { return &k.curl_change[0]; }, change_cosine, change_sine,
            L::splat(region_.onset > 1e-12f ? region_.onset : 1e-12f), kappa - rest_kappa);
    }

    const SetupRegion& region_;
    SetupColumns& columns_;
    std::size_t first_;
    bool normals_;
    Result result_;
    Vec alpha_, part_, doublings_, curvature_, one_minus_kappa_;
    SinCos<L> half_, whole_;  // of half the direction, and of the direction
};

template <class L>
GOFFER_FLATTENED void set_up(const SetupRegion& region, SetupColumns& columns, std::size_t count,
                             const bool* wrinkled, bool normals, Coefficients* k, std::size_t step) {
    alignas(64) float place[setup_width], scale[setup_width];
    for (std::size_t first = 0; first < count; first += L::width) {
        const auto run = [&](auto result) {
            SetupLanes<L, decltype(result)>(region, columns, first, normals, result)
                .run(place + first, scale + first);
        };
        Coefficients* const to = k + first * step;
        const std::size_t left = count - first;
        if (left >= L::width) {
            run(SeparateResult<L, Lanes::all>{to, step, left});
        } else if (left == 1) {
            run(SeparateResult<L, Lanes::one>{to, step, left});
        } else {
            run(SeparateResult<L, Lanes::some>{to, step, left});
        }
    }
    if (region.rows == nullptr && !region.shaped) return;
    for (std::size_t i = 0; i < count; ++i) {
        if (!wrinkled[i]) {
            if (region.shaped) set_no_amplitude<L>(k[i * step]);
            continue;
        }
        set_amplitude<L>(region, place[i], scale[i], columns.factor[i], k[i * step]);
    }
}

template <class L>
GOFFER_FLATTENED void set_up_lanes(const SetupRegion& region, SetupColumns& columns, bool wrinkled,
                                   bool normals, LaneCoefficients& k) {
    alignas(64) float place[setup_width], scale[setup_width];
    for (std::size_t first = 0; first < setup_width; first += L::width)
        SetupLanes<L, LaneResult<L>>(region, columns, first, normals, {k, first})
            .run(place + first, scale + first);
    float most = 0;
    for (const float doublings : k.doublings) most = doublings > most ? doublings : most;
    for (float& lane : k.most_doublings) lane = most;
    set_lane_amplitudes<L>(region, wrinkled, place, scale, columns.factor, k);
}

}  // namespace goffer::bend
