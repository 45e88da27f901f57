// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "kernel/blend_kernel.hpp"
#include "kernel/deform_batch.hpp"
#include "kernel/neighbor.hpp"

#include <cstddef>

/// Kernels that deform a vertex of many instances at a time, for bodies with few vertices per region: what a
/// region costs there beside its vertices is shared by these instances, and joints lie at the same vertices
/// in all of them. The operations are those of the other kernels, and so are the bits.

namespace goffer::bend {

/// Lanes that are instances. A coefficient has a number per lane; a column has one value for all lanes.
template <class L>
struct LanesOfInstances : L {
    static_assert(setup_width % L::width == 0);
    using Vec = typename L::Vec;
    using L::splat;
    static Vec splat(const InstanceLanes& numbers) { return L::load(numbers); }
    static Vec load(const float* column) { return L::splat(*column); }
    static Vec load(const InstanceLanes* column) { return L::load(*column); }
};

/// The coefficients from instance `lane` on, of as many instances as a register has. What it refers to is no
/// object of its own: of each number, that many lanes may be read.
template <class L>
const LaneCoefficients& from_lane(const LaneCoefficients& k, std::size_t lane) {
    return reinterpret_cast<const LaneCoefficients&>(reinterpret_cast<const float*>(&k)[lane]);
}

/// Takes the arcs of alpha / 2^doublings to those of alpha.
template <class L>
void double_arc(const LaneCoefficients& k, Bent<L>& b) {
    using Vec = typename L::Vec;
    Vec curvature = L::splat(k.first_curvature), left = L::splat(k.doublings);
    const Vec zero = L::splat(0.0f), one = L::splat(1.0f);
    for (float n = 0; n < k.most_doublings[0]; ++n) {  // the same in all lanes
        const Vec cosine = L::nmadd(curvature, b.arc_x, one);
        b.arc_x = L::where_less(zero, left, curvature * b.arc_z * b.arc_z, b.arc_x);
        b.arc_z = L::where_less(zero, left, b.arc_z * cosine, b.arc_z);
        curvature = curvature + curvature;
        left = left - one;
    }
}

/// Stores the results for the first vertex of `tile`.
template <class L, StreamSet streams>
void store_lanes(const Results<L>& results, InstanceLanes* tile, std::size_t lane) {
    const auto store = [&](std::size_t first, const Vector<L>& vector) {
        for (std::size_t c = 0; c < 3; ++c)
            L::store(tile[(first + c) * tile_vertices] + lane, vector.component[c]);
    };
    store(0, results.position);
    if constexpr (has_normals(streams)) store(3, results.normal);
    if constexpr (has_tangents(streams)) {
        store(6, results.tangent);
        L::store(tile[9 * tile_vertices] + lane, results.tangent_sign);
    }
}

template <class L, Squeeze squeeze, StreamSet streams>
GOFFER_FLATTENED void bend_lanes(const RestColumns& columns, const LaneCoefficients& k, std::size_t first,
                                 std::size_t count, InstanceLanes* tile) {
    using I = LanesOfInstances<L>;
    const RestColumns rest = columns;
    for (std::size_t lane = 0; lane < setup_width; lane += L::width) {
        const LaneCoefficients& some = from_lane<L>(k, lane);
        for (std::size_t v = 0; v < count; ++v) {
            const Bent<I> b = turn_batch<I, squeeze, has_normals(streams)>(rest, some, first + v);
            store_lanes<I, streams>(deform_batch<I, squeeze, streams>(rest, some, b, first + v), tile + v,
                                    lane);
        }
    }
}

/// A column whose value for each instance is `lanes`, whatever the vertex.
template <class L>
struct LaneColumn {
    const InstanceLanes& lanes;
    const InstanceLanes* operator+(std::size_t /*vertex*/) const { return &lanes; }
};

/// What a vertex near a joint has of its wrinkle, of as many instances as a register has.
template <class L>
struct WrinkledLanes {
    alignas(64) InstanceLanes rho, normal[3], tangent[3], nothing = {};
};

/// The columns of such a vertex: rho and directions are those of each instance, and nothing is added to them.
/// Inherits privately, so that nobody reads the body's rho and directions through it.
template <class L>
class WrinkledColumns : private RestColumns {
public:
    WrinkledColumns(const RestColumns& rest, const WrinkledLanes<L>& lanes) : RestColumns(rest), of(lanes) {}

    using RestColumns::cos_beta, RestColumns::sin_beta, RestColumns::cos_half_beta,
        RestColumns::sin_half_beta;
    using RestColumns::height, RestColumns::tangent_sign, RestColumns::scale, RestColumns::drift;
    using RestColumns::rest_cosine, RestColumns::rest_sine, RestColumns::per_rest_scale;

    const WrinkledLanes<L>& of;
    LaneColumn<L> rho = {of.rho};
    LaneColumn<L> normal[3] = {{of.normal[0]}, {of.normal[1]}, {of.normal[2]}};
    LaneColumn<L> tangent[3] = {{of.tangent[0]}, {of.tangent[1]}, {of.tangent[2]}};
    LaneColumn<L> radial_offset = {of.nothing}, wrinkle = {of.nothing}, slope = {of.nothing},
                  taper = {of.nothing};
};

template <class L, Squeeze squeeze, StreamSet streams>
GOFFER_FLATTENED void bend_blended_lanes(const RestColumns& rest, const LaneCoefficients& own,
                                         const LaneCoefficients& neighbor, const JointBlend& joint,
                                         std::size_t first, std::size_t count, InstanceLanes* tile) {
    using I = LanesOfInstances<L>;
    constexpr Squeeze bare = squeeze == Squeeze::plain ? Squeeze::none : squeeze;
    constexpr bool directions = has_normals(streams), tangents = has_tangents(streams);
    WrinkledLanes<L> lanes;
    const WrinkledColumns<L> columns(rest, lanes);
    alignas(64) LaneCoefficients other_k;
    const auto take = [](const InstanceLanes& from, float factor, InstanceLanes& to) {
        L::store(to, L::splat(factor) * L::load(from));
    };
    for (std::size_t lane = 0; lane < setup_width; lane += L::width) {
        const LaneCoefficients& k = from_lane<L>(own, lane);
        take_as_own(from_lane<L>(neighbor, lane), joint, squeeze == Squeeze::relative, other_k, take);
        for (std::size_t v = 0; v < count; ++v) {
            const Wrinkled<I> wrinkled =
                blend_batch<I, squeeze, directions>(rest, k, other_k, joint, tangents, first + v);
            L::store(lanes.rho, wrinkled.rho);
            for (std::size_t c = 0; directions && c < 3; ++c)
                L::store(lanes.normal[c], wrinkled.normal.component[c]);
            for (std::size_t c = 0; tangents && c < 3; ++c)
                L::store(lanes.tangent[c], wrinkled.tangent.component[c]);
            const Bent<I> b = turn_batch<I, bare, directions>(columns, k, first + v);
            store_lanes<I, streams>(deform_batch<I, bare, streams>(columns, k, b, first + v), tile + v, lane);
        }
    }
}

/// Takes four vertices of each lane at a time.
template <class L>
GOFFER_FLATTENED void untile(const InstanceLanes* value, float* const* to) {
    for (std::size_t lane = 0; lane < setup_width; lane += L::width) {
        for (std::size_t v = 0; v < tile_vertices; v += 4) {
            const InstanceLanes* const from = value + v;
            L::for_rows(L::load(from[0] + lane), L::load(from[1] + lane), L::load(from[2] + lane),
                        L::load(from[3] + lane),
                        [&](std::size_t i, typename L::Row row) { L::store_row(to[lane + i] + v, row); });
        }
    }
}

}  // namespace goffer::bend
