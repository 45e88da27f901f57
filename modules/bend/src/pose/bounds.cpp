// SPDX-License-Identifier: MIT
#include "pose/centre_line.hpp"
#include "pose/instance.hpp"

#include <goffer/bend/bounds.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace goffer::bend {
namespace {

static_assert(Bands::count % 4 == 3 && Bands::places >= Bands::count + 5,
              "Fours of edges, and all bands in them");
constexpr std::size_t edges = Bands::count + 1;

/// The widest vertex and the deepest wrinkles of four bands, or of what meets at four edges.
struct Girth {
    Four rho, lift, dip;  // rho below 0: no vertex there
};

Girth of_bands(const Bands& bands, std::size_t j) noexcept {
    return {load_four(&bands.rho[j + 1]), load_four(&bands.lift[j + 1]), load_four(&bands.dip[j + 1])};
}

/// Edge j is where bands j - 1 and j meet.
Girth at_edges(const Bands& bands, std::size_t j) noexcept {
    const Girth behind = of_bands(bands, j);
    return {larger(behind.rho, load_four(&bands.rho[j])), larger(behind.lift, load_four(&bands.lift[j])),
            larger(behind.dip, load_four(&bands.dip[j]))};
}

/// How far cross-sections reach along an axis, and against it.
struct Reach {
    Four up, down;
};

/// `value` where the comparison holds, else 0.
template <class Mask>
Four where(Mask holds, Four value) noexcept {
    return std::bit_cast<Four>(holds & std::bit_cast<Mask>(value));
}

/// `radius`: in each sector, no smaller than in the one before. (a, b): the axis within the section's plane,
/// a towards the bend, b >= 0 across; `whole` its length there. Of an arc the farthest point is where the
/// axis points to, or an end; of two that meet, the inner one's.
inline Reach reach(const Four (&radius)[sectors], Four a, Four b, Four whole) noexcept {
    const Four half = all(0.5f) * whole, slant = all(0.8660254f) * b, middle = radius[2] * b;
    const auto towards = [&](Four c, Four half_c) {
        const Four outer = larger(radius[0], where(c > -half, radius[1]));
        const Four inner = larger(where(c > 0, radius[2]), where(c > half, radius[3]));
        const Four ends = larger(radius[3] * larger(c, slant + half_c), radius[1] * (slant - half_c));
        return larger(larger(ends, middle), larger(outer, inner) * whole);
    };
    const Four half_a = all(0.5f) * a;
    return {towards(a, half_a), towards(-a, -half_a)};
}

inline Reach reach(const Girth& girth, Four amplitude, Four a, Four b, Four whole) noexcept {
    Four radius[sectors], through[sectors];
    for (int i = 0; i < sectors; ++i) {
        radius[i] = girth.rho + all(amplitude[i]) * girth.lift;
        through[i] = all(amplitude[i]) * girth.dip;
    }
    const Reach outside = reach(radius, a, b, whole);
    const auto crosses = through[sectors - 1] > girth.rho;
    if ((crosses[0] | crosses[1] | crosses[2] | crosses[3]) == 0) return outside;
    // Wrinkles deeper than the radius move vertices through the axis to its other side.
    const Reach inside_out = reach(through, a, b, whole);
    return {larger(outside.up, inside_out.down), larger(outside.down, inside_out.up)};
}

/// Where a body lies along one axis of the streams' space; (m0, m1, m2) is that axis along n, b, t.
///
/// A band is its widest cross-section, moved along its piece of the arc. Each point of the section goes along
/// a circle then, and is farthest where that begins, where it ends, or where it runs square to the axis:
/// nothing but the sections there counts.
class Extent {
public:
    Extent(const Coefficients& k, int row) noexcept
        : m0_(k.matrix[row]), m2_(k.matrix[8 + row]), across_(all(std::fabs(k.matrix[4 + row]))) {
        in_plane_ = std::sqrt(m0_ * m0_ + m2_ * m2_);
        whole_ = std::sqrt(m0_ * m0_ + m2_ * m2_ + across_[0] * across_[0]);
    }

    /// The edges from j on.
    void take_edges(const CentreLine& line, std::size_t j, const Girth& girth, Four amplitude) noexcept {
        const Four at = all(m0_) * line.x + all(m2_) * line.z;
        const Four a = all(m0_) * line.cosine - all(m2_) * line.sine;
        store_four(at_ + j, at);
        store_four(a_ + j, a);
        store_four(tau_ + j, all(m0_) * line.sine + all(m2_) * line.cosine);
        take(girth, amplitude, at, a, root(a * a + across_ * across_));
    }

    /// The bands that run square to the axis somewhere, once all edges are taken. `radius` and `sagitta` of
    /// the centre line in a band, for an axis in the bend's plane.
    void take_bands(const Bands& bands, Four amplitude, float radius, float sagitta) noexcept {
        for (std::size_t j = 0; j < Bands::count; ++j) {
            if (!(tau_[j] * tau_[j + 1] < 0) || bands.rho[j + 1] < 0) continue;
            // From the nearer edge, so that little cancels.
            const std::size_t i = std::fabs(tau_[j]) < std::fabs(tau_[j + 1]) ? j : j + 1;
            const float rise =
                std::min(radius * tau_[i] * tau_[i] / (in_plane_ + std::fabs(a_[i])), sagitta * in_plane_);
            const float side = a_[i] > 0 ? 1.0f : -1.0f;
            const Girth girth = {all(bands.rho[j + 1]), all(bands.lift[j + 1]), all(bands.dip[j + 1])};
            take(girth, amplitude, all(at_[i] - side * rise), all(side * in_plane_), all(whole_));
        }
    }

    /// Bands from j on that each go all round a circle of `radius`.
    void take_circles(const Girth& girth, Four amplitude, float radius) noexcept {
        for (const float side : {-1.0f, 1.0f}) {
            take(girth, amplitude, all((m0_ - side * in_plane_) * radius), all(side * in_plane_),
                 all(whole_));
        }
    }

    /// Length of the axis: of the transform's scale.
    [[nodiscard]] float whole() const noexcept { return whole_; }
    [[nodiscard]] float low() const noexcept { return std::min({low_[0], low_[1], low_[2], low_[3]}); }
    [[nodiscard]] float high() const noexcept { return std::max({high_[0], high_[1], high_[2], high_[3]}); }

private:
    void take(const Girth& girth, Four amplitude, Four at, Four a, Four whole) noexcept {
        const auto [up, down] = reach(girth, amplitude, a, across_, whole);
        const auto none = girth.rho < 0;
        high_ = none ? high_ : larger(high_, at + up);
        low_ = none ? low_ : smaller(low_, at - down);
    }

    float m0_, m2_;
    Four across_;
    float in_plane_, whole_;
    float at_[edges], a_[edges], tau_[edges];  // of the centre line; tau: the axis along it
    Four low_ = all(std::numeric_limits<float>::max());
    Four high_ = all(std::numeric_limits<float>::lowest());
};

/// The bounds of one region's vertices, of which there must be one.
Bounds bounds_of(const Bands& bands, const Coefficients& k) noexcept {
    const Four amplitude = amplitudes(k);
    const float height = (bands.highest - bands.lowest) / static_cast<float>(Bands::count);
    const float length = k.one_minus_kappa * k.reach[0] * height;  // of a band's arc; reach[0] is L
    const float turn = k.curvature * k.reach[0] * height;
    const float radius = k.one_minus_kappa / k.curvature;
    Extent extents[3] = {Extent(k, 0), Extent(k, 1), Extent(k, 2)};
    for (std::size_t j = 0; j < edges; j += 4) {
        if (turn > 3) {  // nearly half a turn: all of the circle
            for (Extent& extent : extents) extent.take_circles(of_bands(bands, j), amplitude, radius);
            continue;
        }
        const Four place = all(static_cast<float>(j)) + Four{0, 1, 2, 3};
        const CentreLine line = centre_line(k, all(bands.lowest) + place * all(height));
        const Girth girth = at_edges(bands, j);
        for (Extent& extent : extents) extent.take_edges(line, j, girth, amplitude);
    }
    Bounds bounds;
    for (int row = 0; row < 3; ++row) {
        Extent& extent = extents[row];
        if (!(turn > 3)) extent.take_bands(bands, amplitude, radius, length * turn / 8);
        const float margin = 1e-5f * extent.whole() * k.reach[0] + 1e-6f * std::fabs(k.offset[row]);
        bounds.low[row] = k.offset[row] + extent.low() - margin;
        bounds.high[row] = k.offset[row] + extent.high() + margin;
    }
    return bounds;
}

Bounds bounds_of(const Posed& posed) noexcept {
    Coefficients k;
    Joint second;
    prepare_region(posed, 0, posed.body->frame().base, k, second);
    return bounds_of(posed, k, second);
}

}  // namespace

Bounds bounds_of(const Posed& posed, const Coefficients& first, const Joint& second) noexcept {
    constexpr float far = std::numeric_limits<float>::max();
    Bounds all = {glm::vec3(far), glm::vec3(-far)};
    const auto take = [&](const Region& region, const Coefficients& k) {
        if (region.first == region.last) return;
        const Bounds own = bounds_of(region.bands, k);
        all = {glm::min(all.low, own.low), glm::max(all.high, own.high)};
    };
    const std::span<const Region> regions = posed.body->regions();
    take(regions[0], first);
    Coefficients k;
    Joint from = second, to;
    for (std::size_t r = 1; r < regions.size(); ++r, from = to) {
        prepare_region(posed, r, from, k, to);
        take(regions[r], k);
    }
    return all;
}

Bounds bounds(const Body& body, const Pose& pose, const glm::mat4x3& transform) noexcept {
    return bounds_of({&body, &pose, &transform, true});
}

Bounds bounds(const Body& body, std::span<const Pose> poses, const glm::mat4x3& transform) noexcept {
    return bounds_of({&body, poses.data(), &transform, true});
}

Bounds bounds(const DeformJob& job) noexcept {
    return bounds_of({job.body, poses_of(job), &job.transform, job.wrinkles});
}

void bounds(std::span<const DeformJob> jobs, std::span<Bounds> result) noexcept {
    for (std::size_t i = 0; i < jobs.size(); ++i) result[i] = bounds(jobs[i]);
}

}  // namespace goffer::bend
