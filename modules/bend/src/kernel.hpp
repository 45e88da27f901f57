// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_args.hpp"

/// The deformation of a batch of vertices, written once for all instruction sets. `L` is ScalarLanes or
/// XsimdLanes<Arch>.
///
/// h = cos((beta - theta) / 2) and h' = sin((beta - theta) / 2) come from stored half angles by a rotation,
/// and give c = cos(beta - theta) = 2 h^2 - 1, s = 2 h h', and sqrt(q) = sqrt(2 kappa) |h| without a root. At
/// alpha = 0 every term that bends vanishes exactly.

namespace goffer::bend {

template <class L, std::size_t N>
typename L::Vec polynomial(const float (&coefficients)[N], typename L::Vec x) {
    typename L::Vec sum = L::set(coefficients[N - 1]);
    for (std::size_t n = N - 1; n-- > 0;) sum = L::madd(sum, x, L::set(coefficients[n]));
    return sum;
}

/// What positions, normals and tangents of one batch share.
template <class L>
struct Bent {
    using Vec = typename L::Vec;
    Vec h, h_prime, t;      // t = h^2
    Vec c, s;               // cos and sin of beta - theta
    Vec amplitude, growth;  // A; rho' / rho = 1 + A shape / rho
    Vec rho_c, rho_s;       // rho' c, rho' s
    Vec rise, reach;        // L (1 - cos delta) / alpha, L sin delta / alpha
    Vec stretch;            // (1 - kappa) - alpha / L rho' c: d(arc) / dz
};

template <class L>
Bent<L> bend_batch(const KernelArgs& args, const Coefficients& k, std::size_t i) {
    using Vec = typename L::Vec;
    Bent<L> b;

    const Vec cos_half = L::load(args.cos_half_beta + i);
    const Vec sin_half = L::load(args.sin_half_beta + i);
    const Vec ct = L::set(k.cos_half_direction);
    const Vec st = L::set(k.sin_half_direction);
    b.h = L::madd(sin_half, st, cos_half * ct);
    b.h_prime = L::nmadd(cos_half, st, sin_half * ct);
    b.t = b.h * b.h;
    b.c = b.t + b.t - L::set(1.0f);
    b.s = (b.h + b.h) * b.h_prime;

    b.amplitude = L::abs(b.h) * polynomial<L>(k.amplitude, b.t);
    b.growth = L::madd(b.amplitude, L::load(args.wrinkle + i), L::set(1.0f));
    const Vec rho = L::load(args.rho + i) * b.growth;
    b.rho_c = rho * b.c;
    b.rho_s = rho * b.s;

    const Vec v = L::load(args.height + i);
    const Vec vv = v * v;
    b.rise = vv * polynomial<L>(k.rise, vv);
    b.reach = v * polynomial<L>(k.reach, vv);
    float curvature = k.first_curvature;
    for (int n = 0; n < k.doublings; ++n) {  // cos 2x = 1 - 2 sin^2 x, sin 2x = 2 sin x cos x
        const Vec cosine = L::nmadd(L::set(curvature), b.rise, L::set(1.0f));
        b.rise = L::set(curvature) * b.reach * b.reach;
        b.reach = b.reach * cosine;
        curvature += curvature;
    }
    b.stretch = L::nmadd(L::set(k.curvature), b.rho_c, L::set(k.one_minus_kappa));
    return b;
}

/// A vector per lane, in model space.
template <class L>
struct Vector {
    typename L::Vec component[3];
};

/// Turns (x, y, z) from the middle frame to model space and adds `offset` unless null.
template <class L>
Vector<L> place(const float* matrix, const float* offset, typename L::Vec x, typename L::Vec y,
                typename L::Vec z) {
    Vector<L> result;
    for (int row = 0; row < 3; ++row) {
        typename L::Vec sum =
            offset ? L::madd(L::set(matrix[row]), x, L::set(offset[row])) : L::set(matrix[row]) * x;
        sum = L::madd(L::set(matrix[3 + row]), y, sum);
        result.component[row] = L::madd(L::set(matrix[6 + row]), z, sum);
    }
    return result;
}

/// A vector given in the bent frame (n, b, t) at the vertex, to unit length and to model space.
template <class L>
Vector<L> place_direction(const Coefficients& k, const Bent<L>& b, typename L::Vec n, typename L::Vec bt,
                          typename L::Vec t) {
    using Vec = typename L::Vec;
    const Vec cosine = L::nmadd(L::set(k.curvature), b.rise, L::set(1.0f));
    const Vec sine = L::set(k.curvature) * b.reach;
    const Vec p = L::nmadd(b.s, bt, b.c * n);
    const Vec x = L::madd(p, cosine, t * sine);
    const Vec y = L::madd(b.c, bt, b.s * n);
    const Vec z = L::nmadd(p, sine, t * cosine);
    // Last, so that the roundings of sines and cosines go out as well. A vector that the map squeezed to
    // nothing stays zero: the bound keeps its root finite.
    const Vec inverse = L::rsqrt(L::madd(x, x, L::madd(y, y, z * z)) + L::set(1e-30f));
    return place<L>(k.matrix, nullptr, x * inverse, y * inverse, z * inverse);
}

/// The Jacobian's entries in the bent frame (DESIGN's 2.3): rows (a, b, d), (0, growth, 0), (0, 0, stretch).
template <class L>
struct Jacobian {
    typename L::Vec a, b, d;
};

template <class L>
Jacobian<L> jacobian(const KernelArgs& args, const Coefficients& k, const Bent<L>& bent, std::size_t i) {
    using Vec = typename L::Vec;
    // A has a corner where h changes sign, on the outer line; across it the two slopes are blended
    // (crease_width).
    const Vec sign = L::clamp(bent.h * L::set(1000.0f), L::set(-1.0f), L::set(1.0f));
    const Vec slope = sign * bent.h_prime * polynomial<L>(k.amplitude_slope, bent.t);
    // Below half the radius the depth weight grows like rho, so the wrinkle stretches rho as it stretches the
    // circle.
    return {L::where_less(L::load(args.rho + i), L::set(k.half_radius), bent.growth, L::set(1.0f)),
            slope * L::load(args.wrinkle + i), bent.amplitude * L::load(args.slope + i)};
}

template <class L>
Vector<L> bend_normals(const KernelArgs& args, const Coefficients& k, const Bent<L>& b, const Jacobian<L>& j,
                       std::size_t i) {
    using Vec = typename L::Vec;
    const Vec rho = L::load(args.normal[0] + i);
    const Vec beta = L::load(args.normal[1] + i);
    const Vec z = L::load(args.normal[2] + i);
    const Vec n = b.growth * b.stretch * rho;
    const Vec bt = b.stretch * L::nmadd(j.b, rho, j.a * beta);
    const Vec t = b.growth * L::nmadd(j.d, rho, j.a * z);
    return place_direction<L>(k, b, n, bt, t);
}

template <class L>
Vector<L> bend_tangents(const KernelArgs& args, const Coefficients& k, const Bent<L>& b, const Jacobian<L>& j,
                        std::size_t i) {
    using Vec = typename L::Vec;
    const Vec rho = L::load(args.tangent[0] + i);
    const Vec beta = L::load(args.tangent[1] + i);
    const Vec z = L::load(args.tangent[2] + i);
    const Vec n = L::madd(j.a, rho, L::madd(j.b, beta, j.d * z));
    return place_direction<L>(k, b, n, b.growth * beta, b.stretch * z);
}

/// What is wanted of one batch; only the wanted parts are set and used.
template <class L>
struct Results {
    Vector<L> position, normal, tangent;
};

template <class L, unsigned streams>
Results<L> deform_batch(const KernelArgs& args, const Coefficients& k, std::size_t i) {
    Results<L> results;
    const Bent<L> b = bend_batch<L>(args, k, i);
    if constexpr ((streams & 1) != 0) {
        results.position =
            place<L>(k.matrix, k.offset, L::madd(b.rise, b.stretch, b.rho_c), b.rho_s, b.reach * b.stretch);
    }
    if constexpr ((streams & 6) != 0) {
        const Jacobian<L> j = jacobian<L>(args, k, b, i);
        if constexpr ((streams & 2) != 0) results.normal = bend_normals<L>(args, k, b, j, i);
        if constexpr ((streams & 4) != 0) results.tangent = bend_tangents<L>(args, k, b, j, i);
    }
    return results;
}

/// Stores one batch, or the batches of one cache line: a line is written whole before the next one is begun,
/// since the processor has few buffers for lines that are written past the cache.
template <class L, bool streaming, std::size_t batches>
void store(const Results<L> (&results)[batches], Vector<L> Results<L>::*part, float* const (&out)[3],
           std::size_t i) {
    for (int c = 0; c < 3; ++c) {
        for (std::size_t b = 0; b < batches; ++b) {
            const typename L::Vec value = (results[b].*part).component[c];
            if constexpr (streaming) {
                L::stream(out[c] + i + b * L::width, value);
            } else {
                L::store(out[c] + i + b * L::width, value);
            }
        }
    }
}

// Flattened: one loop without calls, whose constants stay in registers as far as there are any. The copies of
// what the arguments point to tell the compiler that no store changes them.
template <class L, unsigned streams, bool streaming>
[[gnu::flatten]] void bend_range(const KernelArgs& arguments, std::size_t first, std::size_t last) {
    const KernelArgs args = arguments;
    const Coefficients k = *arguments.coefficients;
    constexpr std::size_t batches = streaming ? line_floats / L::width : 1;
    for (std::size_t i = first; i < last; i += batches * L::width) {
        Results<L> results[batches];
        for (std::size_t b = 0; b < batches; ++b)
            results[b] = deform_batch<L, streams>(args, k, i + b * L::width);
        if constexpr ((streams & 1) != 0)
            store<L, streaming>(results, &Results<L>::position, args.position_out, i);
        if constexpr ((streams & 2) != 0)
            store<L, streaming>(results, &Results<L>::normal, args.normal_out, i);
        if constexpr ((streams & 4) != 0)
            store<L, streaming>(results, &Results<L>::tangent, args.tangent_out, i);
    }
    if constexpr (streaming) L::fence();
}

template <class L>
constexpr KernelSet kernel_set() {
    return {
        L::width,
        {nullptr, &bend_range<L, 1, false>, &bend_range<L, 2, false>, &bend_range<L, 3, false>,
         &bend_range<L, 4, false>, &bend_range<L, 5, false>, &bend_range<L, 6, false>,
         &bend_range<L, 7, false>},
        {nullptr, &bend_range<L, 1, true>, &bend_range<L, 2, true>, &bend_range<L, 3, true>,
         &bend_range<L, 4, true>, &bend_range<L, 5, true>, &bend_range<L, 6, true>, &bend_range<L, 7, true>}};
}

}  // namespace goffer::bend
