// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/bend_kernel.hpp"
#include "kernel/deform_batch.hpp"

/// Kernels for vertices near a joint, where the wrinkles of two regions pass into each other. They wrinkle
/// the rest columns, and leave the bend to the kernel without wrinkles: the map is one after the other. That
/// takes half as long again as a kernel of both, but a kernel of both would need copies for all streams.
/// (Those of lane_kernel.hpp, which write to one place alone, are of both.) See modules/paper/README.md,
/// "Folds over joints".

namespace goffer::bend {

/// What a vertex near a joint takes of the region that it is not in.
template <class L>
struct Share {
    typename L::Vec value;
    typename L::Vec slope;  // its derivative by z
};

template <class L>
Share<L> share_of_neighbor(const JointBlend& joint, typename L::Vec height) {
    using Vec = typename L::Vec;
    // Without a fused operation, so that 0 is what Joint::nears() takes for it.
    const Vec x =
        L::clamp(L::splat(joint.per_height) * height + L::splat(joint.at), L::splat(0.0f), L::splat(1.0f));
    return {x * x * (L::splat(1.5f) - x), L::splat(3.0f * joint.per_length) * L::nmadd(x, x, x)};
}

/// Returns the first `count` lanes, and 0 in the others.
template <class L>
typename L::Vec first_lanes(typename L::Vec value, std::size_t count) {
    static constexpr float numbers[max_unit] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                                11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                                22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    return L::where_less(L::load(numbers), L::splat(static_cast<float>(count)), value, L::splat(0.0f));
}

/// Sets what the columns of `b` have of their wrinkle.
template <class L, Squeeze squeeze, bool directions, class K>
void set_wrinkle(const RestColumns& rest, const K& k, Bent<L>& b, std::size_t i) {
    if constexpr (squeeze == Squeeze::relative) {
        set_relative_wrinkle<L, directions>(load_rest_terms<L>(rest, i), k, b);
    } else {
        set_plain_column<L, squeeze, directions>(rest, k, load_scale<L, squeeze>(rest, i), b, i);
    }
}

/// Sets the relative wrinkle that the neighbor makes of columns, whose rest arc may be another. `at` is over
/// S_0 of the region itself, and so is the amplitude: `ratio` takes one S_0 to the other. Columns that have
/// no share of it are 0, and have the ratio 1.
template <class L, bool directions, class K>
void set_relative_wrinkle_beyond(RestTerms<L> at, const K& k, const JointBlend& joint, Bent<L>& b) {
    using Vec = typename L::Vec;
    const Vec one = L::splat(1.0f);
    const Vec more = L::madd(
        L::splat(joint.rest_curl[1]), at.sine,
        L::madd(L::splat(joint.rest_curl[0]), at.cosine, L::splat(joint.rest_kappa) * at.per_rest_scale));
    const Vec ratio = one + more, inverse = L::reciprocal(ratio);  // more than 0.01: see Body::check
    at = {at.cosine * inverse, at.sine * inverse, at.per_rest_scale * inverse};
    set_relative_wrinkle<L, directions>(at, k, b);
    if constexpr (directions) {
        b.less_by_scale = L::madd(b.amplitude, more, b.less_by_scale);
        b.slope = b.slope * ratio;
    }
    b.amplitude = b.amplitude * ratio;
}

/// Sets what the columns of `b` have of the wrinkle of the region beyond `joint`. Where a vertex has no share
/// of it, the column counts as one without thickness, since the neighbor's table may not be made for its own.
template <class L, Squeeze squeeze, bool directions, class K>
void set_neighbor_wrinkle(const RestColumns& rest, const K& k, const JointBlend& joint, typename L::Vec share,
                          Bent<L>& b, std::size_t i) {
    const auto if_near = [share](typename L::Vec value) {
        const typename L::Vec zero = L::splat(0.0f);
        return L::where_less(zero, share, value, zero);
    };
    if constexpr (squeeze == Squeeze::relative) {
        const auto [cosine, sine, per_rest_scale] = load_rest_terms<L>(rest, i);
        const RestTerms<L> at = {if_near(cosine), if_near(sine), if_near(per_rest_scale)};
        set_relative_wrinkle_beyond<L, directions>(at, k, joint, b);
    } else {
        set_plain_column<L, squeeze, directions>(rest, k, if_near(load_scale<L, squeeze>(rest, i)), b, i);
    }
}

/// Rest columns that have their wrinkle. Directions are set only if they are wanted.
template <class L>
struct Wrinkled {
    typename L::Vec rho;
    Vector<L> normal, tangent;
};

template <class L>
Vector<L> load_vector(const float* const (&planes)[3], std::size_t i) {
    return {{L::load(planes[0] + i), L::load(planes[1] + i), L::load(planes[2] + i)}};
}

/// Wrinkles the batch that begins at vertex `i`. Those behind the first `wanted` take nothing of the
/// neighbor: they may be another region's.
template <class L, Squeeze squeeze, bool directions, class K>
Wrinkled<L> blend_batch(const RestColumns& rest, const K& k, const K& other_k, const JointBlend& joint,
                        bool tangents, std::size_t i, std::size_t wanted = L::width) {
    using Vec = typename L::Vec;
    Wrinkled<L> result;
    Bent<L> b, other;
    Share<L> share = share_of_neighbor<L>(joint, L::load(rest.height + i));
    if (wanted < L::width) share = {first_lanes<L>(share.value, wanted), first_lanes<L>(share.slope, wanted)};
    set_wrinkle<L, squeeze, directions>(rest, k, b, i);
    set_neighbor_wrinkle<L, squeeze, directions>(rest, other_k, joint, share.value, other, i);
    const Vec difference = other.amplitude - b.amplitude;
    b.amplitude = L::madd(share.value, difference, b.amplitude);
    const Vec offset = L::load(rest.radial_offset + i);
    result.rho = L::madd(b.amplitude, offset, L::load(rest.rho + i));
    if constexpr (directions) {
        b.slope = L::madd(share.value, other.slope - b.slope, b.slope);
        if (has_shape<squeeze>(rest))
            b.less_by_scale = L::madd(share.value, other.less_by_scale - b.less_by_scale, b.less_by_scale);
        Jacobian<L> jacobian = bend::jacobian<L, squeeze>(rest, k, b, i);
        jacobian.along = L::madd(share.slope * difference, offset, jacobian.along);
        const auto& [outward, across, along, around] = jacobian;
        const auto [n_rho, n_beta, n_z] = load_vector<L>(rest.normal, i).component;
        result.normal = {{around * n_rho, L::nmadd(across, n_rho, outward * n_beta),
                          around * L::nmadd(along, n_rho, outward * n_z)}};
        if (!tangents) return result;
        const auto [t_rho, t_beta, t_z] = load_vector<L>(rest.tangent, i).component;
        result.tangent = {
            {L::madd(outward, t_rho, L::madd(across, t_beta, along * t_z)), around * t_beta, t_z}};
    }
    return result;
}

template <class L>
void store_vector(const Vector<L>& vector, float (&planes)[3][BlendColumns::places], std::size_t j) {
    for (std::size_t c = 0; c < 3; ++c) L::store(planes[c] + j, vector.component[c]);
}

template <class L, Squeeze squeeze, bool directions>
GOFFER_FLATTENED void blend_wrinkles(const RestColumns& columns, const Coefficients& own,
                                     const Coefficients& neighbor, const JointBlend& joint, std::size_t first,
                                     std::size_t count, std::size_t wanted, bool tangents,
                                     BlendColumns& out) {
    const RestColumns rest = columns;
    const Coefficients k = own, other_k = neighbor;
    for (std::size_t at = 0; at < count; at += L::width) {
        const std::size_t j = at + L::width <= count ? at : count - L::width;
        const Wrinkled<L> batch = blend_batch<L, squeeze, directions>(rest, k, other_k, joint, tangents,
                                                                      first + j, wanted < j ? 0 : wanted - j);
        L::store(out.rho + j, batch.rho);
        if constexpr (directions) {
            store_vector<L>(batch.normal, out.normal, j);
            if (tangents) store_vector<L>(batch.tangent, out.tangent, j);
        }
    }
}

}  // namespace goffer::bend
