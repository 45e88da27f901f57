// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/sin_cos.hpp"

/// The deformation of a batch of vertices, written once for all instruction sets. `L` is any lanes.
///
/// Columns hold sines and cosines of half angles, times the root of two. A rotation makes h = sqrt(2)
/// cos((beta - theta) / 2) and h' = sqrt(2) sin((beta - theta) / 2) from them. With c = cos(beta - theta)
/// they give T = h^2 = 1 + c, sin(beta - theta) = h h', and sqrt(q) = sqrt(kappa) |h| without a square root,
/// unless the squeeze is relative to a rest arc. At alpha = 0 every term that bends vanishes exactly.
/// See modules/paper/README.md, "Bend".
///
/// Local vectors are not const: g++ 12 stores const ones that are two registers wide to the stack in every
/// iteration, where nothing reads them, and stores past the cache wait for that.

namespace goffer::bend {

template <class L, class Number, std::size_t N>
typename L::Vec polynomial(const Number (&coefficients)[N], typename L::Vec x) {
    typename L::Vec sum = L::splat(coefficients[N - 1]);
    for (std::size_t n = N - 1; n-- > 0;) sum = L::madd(sum, x, L::splat(coefficients[n]));
    return sum;
}

/// The same for an even N, with even and odd powers side by side: one operation more, but half the latency.
template <class L, class Number, std::size_t N>
typename L::Vec long_polynomial(const Number (&coefficients)[N], typename L::Vec x) {
    typename L::Vec xx = x * x;
    typename L::Vec even = L::splat(coefficients[N - 2]);
    typename L::Vec odd = L::splat(coefficients[N - 1]);
    for (std::size_t n = N - 2; n > 0; n -= 2) {
        even = L::madd(even, xx, L::splat(coefficients[n - 2]));
        odd = L::madd(odd, xx, L::splat(coefficients[n - 1]));
    }
    return L::madd(odd, x, even);
}

/// 1 / crease_width, for a cosine times the root of two.
constexpr float per_crease_width = 0.70710678f / crease_width;

/// What positions, normals and tangents of one batch share.
template <class L>
struct Bent {
    using Vec = typename L::Vec;
    Vec c, s;           // cos and sin of beta - theta
    Vec amplitude;      // A; A / S_0 where the squeeze is relative
    Vec slope;          // its derivative by beta
    Vec less_by_scale;  // minus its derivative by ln(s), up to a factor that is in RestColumns::taper
    Vec rho_c, rho_s;   // rho' c, rho' s
    Vec arc_x, arc_z;   // L (1 - cos delta) / alpha, L sin delta / alpha
    Vec stretch;        // (1 - kappa) - alpha / L rho' c: d(arc) / dz
};

/// Sine and cosine of the columns' angles minus the instance's. A factor on those of the columns, such as the
/// root of two, carries over.
template <class L, class Number>
SinCos<L> rotated_by(SinCos<L> columns, const Number& cos_direction, const Number& sin_direction) {
    typename L::Vec ct = L::splat(cos_direction), st = L::splat(sin_direction);
    return {L::nmadd(columns.cosine, st, columns.sine * ct), L::madd(columns.sine, st, columns.cosine * ct)};
}

/// Whether a body has a shape. Only kernels of relative squeezes have to ask: a branch costs the plain ones
/// up to a fifth of their speed, in registers.
template <Squeeze squeeze, class Rest>
bool has_shape(const Rest& rest) {
    return squeeze == Squeeze::shaped || (squeeze == Squeeze::relative && rest.scale != nullptr);
}

/// Loads s where a plain kernel asks for it, or else returns 1.
template <class L, Squeeze squeeze, class Rest>
typename L::Vec load_scale(const Rest& rest, std::size_t i) {
    if constexpr (squeeze == Squeeze::shaped) return L::load(rest.scale + i);
    return L::splat(1.0f);
}

/// Sets the directions of columns, and their wrinkle if they are squeezed by q = kappa s T, with s = `scale`.
template <class L, Squeeze squeeze, bool slope, class Rest, class K>
void set_plain_column(const Rest& rest, const K& k, typename L::Vec scale, Bent<L>& b, std::size_t i) {
    using Vec = typename L::Vec;
    auto [h_prime, h] = rotated_by<L>({L::load(rest.sin_half_beta + i), L::load(rest.cos_half_beta + i)},
                                      k.cos_half_direction, k.sin_half_direction);
    Vec t = h * h;
    b.c = t - L::splat(1.0f);
    b.s = h * h_prime;
    Vec x = t;
    if constexpr (squeeze == Squeeze::shaped) x = t * scale;
    if constexpr (squeeze == Squeeze::none) return;
    Vec size = L::abs(h);
    b.amplitude = size * long_polynomial<L>(k.amplitude, x);
    if constexpr (slope) {
        // A has a corner on the outer line, where h changes sign; the two slopes are blended across it.
        Vec sign = L::clamp(h * L::splat(per_crease_width), L::splat(-1.0f), L::splat(1.0f));
        Vec per_turn = long_polynomial<L>(k.amplitude_slope, x);
        b.slope = sign * h_prime * per_turn;
        if constexpr (squeeze == Squeeze::shaped) b.less_by_scale = size * per_turn;
    }
}

/// The columns rest_cosine, rest_sine and per_rest_scale.
template <class L>
struct RestTerms {
    typename L::Vec cosine, sine, per_rest_scale;
};

template <class L, class Rest>
RestTerms<L> load_rest_terms(const Rest& rest, std::size_t i) {
    return {L::load(rest.rest_cosine + i), L::load(rest.rest_sine + i), L::load(rest.per_rest_scale + i)};
}

/// Sets the wrinkle of columns whose squeeze is relative to that at rest.
template <class L, bool slope, class K>
void set_relative_wrinkle(const RestTerms<L>& rest, const K& k, Bent<L>& b) {
    using Vec = typename L::Vec;
    const auto& [rest_cosine, rest_sine, per_rest_scale] = rest;
    Vec zero = L::splat(0.0f);
    Vec q = L::max(
        L::madd(L::splat(k.curl_change[1]), rest_sine,
                L::madd(L::splat(k.curl_change[0]), rest_cosine, L::splat(k.kappa_change) * per_rest_scale)),
        zero);
    Vec per_root = L::rsqrt(q + L::splat(k.onset));
    Vec root = q * per_root;
    Vec x = root * root;
    b.amplitude = root * long_polynomial<L>(k.amplitude, x);
    if constexpr (slope) {
        Vec rest_slope =
            L::nmadd(L::splat(k.rest_curl[1]), rest_cosine, L::splat(k.rest_curl[0]) * rest_sine);
        Vec turned =
            L::nmadd(L::splat(k.curl_change[0]), rest_sine, L::splat(k.curl_change[1]) * rest_cosine);
        Vec q_slope = L::nmadd(q, rest_slope, turned);
        Vec per_q = per_root * L::nmadd(L::splat(0.5f) * root, per_root, L::splat(1.0f)) *
                    long_polynomial<L>(k.amplitude_slope, x);
        b.slope = L::madd(b.amplitude, rest_slope, per_q * L::where_less(zero, q, q_slope, zero));
        b.less_by_scale = per_q * q;
    }
}

/// Sets the directions of columns, and their wrinkle if the squeeze is relative to that at rest.
template <class L, bool slope, class Rest, class K>
void set_relative_column(const Rest& rest, const K& k, Bent<L>& b, std::size_t i) {
    SinCos<L> turn = rotated_by<L>({L::load(rest.sin_beta + i), L::load(rest.cos_beta + i)}, k.cos_direction,
                                   k.sin_direction);
    b.c = turn.cosine;
    b.s = turn.sine;
    set_relative_wrinkle<L, slope>(load_rest_terms<L>(rest, i), k, b);
}

/// Computes what depends on the column of a vertex. `slope`: normals or tangents are wanted.
template <class L, Squeeze squeeze, bool slope, class Rest, class K>
Bent<L> turn_batch(const Rest& rest, const K& k, std::size_t i) {
    using Vec = typename L::Vec;
    Bent<L> b;
    if constexpr (squeeze == Squeeze::relative) {
        set_relative_column<L, slope>(rest, k, b, i);
    } else {
        set_plain_column<L, squeeze, slope>(rest, k, load_scale<L, squeeze>(rest, i), b, i);
    }
    Vec rho = L::load(rest.rho + i);
    if constexpr (squeeze != Squeeze::none) rho = L::madd(b.amplitude, L::load(rest.radial_offset + i), rho);
    b.rho_c = rho * b.c;
    b.rho_s = rho * b.s;
    return b;
}

/// Takes the arc of alpha / 2^doublings to that of alpha.
template <class L>
void double_arc(const Coefficients& k, Bent<L>& b) {
    float curvature = k.first_curvature;
    for (float n = 0; n < k.doublings; ++n) {  // cos 2x = 1 - 2 sin^2 x, sin 2x = 2 sin x cos x
        typename L::Vec cosine = L::nmadd(L::splat(curvature), b.arc_x, L::splat(1.0f));
        b.arc_x = L::splat(curvature) * b.arc_z * b.arc_z;
        b.arc_z = b.arc_z * cosine;
        curvature += curvature;
    }
}

/// Adds what also depends on its height.
template <class L, Squeeze squeeze, class Rest, class K>
void set_arc(const Rest& rest, const K& k, Bent<L>& b, std::size_t i) {
    using Vec = typename L::Vec;
    Vec v = L::load(rest.height + i);
    // To where a cylinder has the same arc angle.
    if (has_shape<squeeze>(rest)) v = L::nmadd(L::splat(k.curvature), L::load(rest.drift + i), v);
    Vec vv = v * v;
    b.arc_x = vv * polynomial<L>(k.arc_x, vv);
    b.arc_z = v * polynomial<L>(k.arc_z, vv);
    double_arc<L>(k, b);
    b.stretch = L::nmadd(L::splat(k.curvature), b.rho_c, L::splat(k.one_minus_kappa));
}

/// What turn_batch leaves for positions, for many batches in a row. With a relative squeeze, its operations
/// are a longer chain than processors look ahead over, and need too many registers. They are faster in a loop
/// of their own. (Plain squeezes and normals get slower by it.)
template <class L>
struct ColumnBuffer {
    static constexpr std::size_t vertices = 256;
    alignas(64) float rho_c[vertices];
    alignas(64) float rho_s[vertices];
};

/// Fills the buffer for the vertices [first, last): a batch at least, ColumnBuffer::vertices at most.
template <class L, Squeeze squeeze>
void fill_column_buffer(const RestColumns& rest, const Coefficients& k, std::size_t first, std::size_t last,
                        ColumnBuffer<L>& buffer) {
    for (std::size_t i = first; i < last; i += L::width) {
        const std::size_t at = i + L::width <= last ? i : last - L::width;
        Bent<L> b = turn_batch<L, squeeze, false>(rest, k, at);
        L::store(buffer.rho_c + (at - first), b.rho_c);
        L::store(buffer.rho_s + (at - first), b.rho_s);
    }
}

/// A vector per lane.
template <class L>
struct Vector {
    typename L::Vec component[3];
};

/// Takes (x, y, z) from the middle frame to the streams' space, and adds `offset` unless it is null.
template <class L, class Number>
Vector<L> place(const Number* matrix, const Number* offset, typename L::Vec x, typename L::Vec y,
                typename L::Vec z) {
    Vector<L> result;
    for (int row = 0; row < 3; ++row) {
        typename L::Vec sum =
            offset ? L::madd(L::splat(matrix[row]), x, L::splat(offset[row])) : L::splat(matrix[row]) * x;
        sum = L::madd(L::splat(matrix[4 + row]), y, sum);
        result.component[row] = L::madd(L::splat(matrix[8 + row]), z, sum);
    }
    return result;
}

/// Takes a vector from the bent frame (n, b, t) at the vertex to the streams' space. Does not keep its
/// length.
template <class L, class K, class Number>
Vector<L> place_direction(const K& k, const Number* matrix, const Bent<L>& b, typename L::Vec n,
                          typename L::Vec bt, typename L::Vec t) {
    using Vec = typename L::Vec;
    Vec cosine = L::nmadd(L::splat(k.curvature), b.arc_x, L::splat(1.0f));
    Vec sine = L::splat(k.curvature) * b.arc_z;
    Vec p = L::nmadd(b.s, bt, b.c * n);
    Vec x = L::madd(p, cosine, t * sine);
    Vec y = L::madd(b.c, bt, b.s * n);
    Vec z = L::nmadd(p, sine, t * cosine);
    return place<L, Number>(matrix, nullptr, x, y, z);
}

/// Brings a vector to unit length. Comes last of all, so that it removes the scale of transforms and
/// roundings. A vector that the map squeezed to zero stays zero: the number added keeps the root finite.
template <class L>
Vector<L> normalized(const Vector<L>& v) {
    using Vec = typename L::Vec;
    const auto& [x, y, z] = v.component;
    Vec inverse = L::rsqrt(L::madd(x, x, L::madd(y, y, z * z)) + L::splat(1e-37f));
    return {{x * inverse, y * inverse, z * inverse}};
}

/// The Jacobian in the bent frame, without Bent::stretch:
///
///     | outward  across  along   |
///     | 0        around  0       |
///     | 0        0       stretch |
///
/// Not used without wrinkles, where outward and around are 1, across and along 0.
/// See modules/paper/README.md, "Normals and tangents".
template <class L>
struct Jacobian {
    typename L::Vec outward, across, along;
    typename L::Vec around;  // rho' / rho
};

/// Takes Bent::stretch of a body with a shape to its value for vectors: the arc angle grows more slowly where
/// the body is thick.
template <class L, class Rest, class K>
void set_shaped_stretch(const Rest& rest, const K& k, Bent<L>& b, std::size_t i) {
    typename L::Vec kappa = L::splat(1.0f) - L::splat(k.one_minus_kappa);
    b.stretch = b.stretch * L::nmadd(kappa, L::load(rest.scale + i), L::splat(1.0f) + kappa);
}

/// A times d(g w)/dz, and what the body's shape adds.
template <class L, Squeeze squeeze, class Rest>
typename L::Vec along(const Rest& rest, const Bent<L>& bent, std::size_t i) {
    typename L::Vec plain = bent.amplitude * L::load(rest.slope + i);
    return has_shape<squeeze>(rest) ? L::nmadd(bent.less_by_scale, L::load(rest.taper + i), plain) : plain;
}

template <class L, Squeeze squeeze, class Rest, class K>
typename L::Vec half_radius(const Rest& rest, const K& k, std::size_t i) {
    typename L::Vec half = L::splat(k.half_radius);
    return has_shape<squeeze>(rest) ? half * L::load(rest.scale + i) : half;
}

template <class L, Squeeze squeeze, class Rest, class K>
Jacobian<L> jacobian(const Rest& rest, const K& k, const Bent<L>& bent, std::size_t i) {
    using Vec = typename L::Vec;
    Vec wrinkle = L::load(rest.wrinkle + i);
    Vec around = L::madd(bent.amplitude, wrinkle, L::splat(1.0f));
    // Below half the radius the depth weight is proportional to rho, so the wrinkle stretches rho as much as
    // the circle.
    Vec outward =
        L::where_less(L::load(rest.rho + i), half_radius<L, squeeze>(rest, k, i), around, L::splat(1.0f));
    return {outward, bent.slope * wrinkle, along<L, squeeze>(rest, bent, i), around};
}

template <class L, Squeeze squeeze, class Rest, class K>
Vector<L> bend_normals(const Rest& rest, const K& k, const Bent<L>& b, const Jacobian<L>& j, std::size_t i) {
    using Vec = typename L::Vec;
    Vec rho = L::load(rest.normal[0] + i);
    Vec beta = L::load(rest.normal[1] + i);
    Vec z = L::load(rest.normal[2] + i);
    if constexpr (squeeze == Squeeze::none) {
        return place_direction<L>(k, k.normal_matrix, b, b.stretch * rho, b.stretch * beta, z);
    } else {
        Vec n = b.stretch * (j.around * rho);  // in this order, as blend_batch has it
        Vec bt = b.stretch * L::nmadd(j.across, rho, j.outward * beta);
        Vec t = j.around * L::nmadd(j.along, rho, j.outward * z);
        return place_direction<L>(k, k.normal_matrix, b, n, bt, t);
    }
}

template <class L, Squeeze squeeze, class Rest, class K>
Vector<L> bend_tangents(const Rest& rest, const K& k, const Bent<L>& b, const Jacobian<L>& j, std::size_t i) {
    using Vec = typename L::Vec;
    Vec rho = L::load(rest.tangent[0] + i);
    Vec beta = L::load(rest.tangent[1] + i);
    Vec z = L::load(rest.tangent[2] + i);
    if constexpr (squeeze == Squeeze::none) {
        return place_direction<L>(k, k.matrix, b, rho, beta, b.stretch * z);
    } else {
        Vec n = L::madd(j.outward, rho, L::madd(j.across, beta, j.along * z));
        return place_direction<L>(k, k.matrix, b, n, j.around * beta, b.stretch * z);
    }
}

/// The three words of PackedVertex. `position` is in steps of the bounds, 0..65535; `normal` may have any
/// length.
template <class L>
Vector<L> pack(const Vector<L>& position, const Vector<L>& normal) {
    using Vec = typename L::Vec;
    Vec zero = L::splat(0.0f);
    const auto step = [&](Vec value) { return L::clamp(value, zero, L::splat(65535.0f)); };
    const auto& [x, y, z] = normal.component;
    // Projects the normal onto the octahedron |x| + |y| + |z| = 1. Below z = 0 it is folded outward: both |x|
    // and |y| grow by |z|.
    Vec sum = L::abs(x) + L::abs(y) + L::abs(z) + L::splat(1e-30f);
    Vec scale = L::reciprocal(sum) * L::splat(32767.0f);
    Vec below = L::max(L::nmadd(z, scale, zero), zero);
    Vec u = x * scale;
    Vec v = y * scale;
    return {{L::pack_int16(step(position.component[0]), step(position.component[1])),
             L::word(step(position.component[2])),
             L::pack_int16(u + L::with_sign(below, u), v + L::with_sign(below, v))}};
}

/// The results of one batch. Only what is wanted is set and used.
template <class L>
struct Results {
    Vector<L> position, normal, tangent;
    typename L::Vec tangent_sign;
};

constexpr bool has_normals(StreamSet streams) {
    return streams != StreamSet::positions;
}

constexpr bool has_tangents(StreamSet streams) {
    return streams == StreamSet::positions_normals_tangents;
}

/// Deforms the batch that begins at vertex `i`. `b` is what turn_batch made of it.
template <class L, Squeeze squeeze, StreamSet streams, class Rest, class K>
Results<L> deform_batch(const Rest& rest, const K& k, Bent<L> b, std::size_t i) {
    Results<L> results;
    set_arc<L, squeeze>(rest, k, b, i);
    results.position =
        place<L>(k.matrix, k.offset, L::madd(b.arc_x, b.stretch, b.rho_c), b.rho_s, b.arc_z * b.stretch);
    if constexpr (has_normals(streams)) {
        if (has_shape<squeeze>(rest)) set_shaped_stretch<L>(rest, k, b, i);
        Jacobian<L> j;
        if constexpr (squeeze != Squeeze::none) j = jacobian<L, squeeze>(rest, k, b, i);
        results.normal = bend_normals<L, squeeze>(rest, k, b, j, i);
        if constexpr (has_tangents(streams)) {
            results.tangent = normalized<L>(bend_tangents<L, squeeze>(rest, k, b, j, i));
            results.tangent_sign = L::splat(k.handedness) * L::load(rest.tangent_sign + i);
        }
    }
    if constexpr (streams == StreamSet::packed) {
        results.position = pack<L>(results.position, results.normal);
    } else if constexpr (has_normals(streams)) {
        results.normal = normalized<L>(results.normal);
    }
    return results;
}

}  // namespace goffer::bend
