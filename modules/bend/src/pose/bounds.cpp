// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"
#include "pose/bounds_of.hpp"
#include "pose/center_line.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/bounds.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace goffer::bend {

using namespace simd;

namespace {

static_assert(Bands::count % 4 == 3 && Bands::places >= Bands::count + 5,
              "Fours of edges, and all bands in them");
constexpr std::size_t edges = Bands::count + 1;

/// The widest vertex and the deepest wrinkles in each of four bands, or in the bands that meet at each of
/// four edges.
struct Girth {
    Float4 rho, outward, inward;  // rho below 0: no vertex there
};

Girth of_bands(const Bands& bands, std::size_t j) noexcept {
    return {load4(&bands.rho[j + 1]), load4(&bands.outward[j + 1]), load4(&bands.inward[j + 1])};
}

/// Edge j is where bands j - 1 and j meet.
Girth at_edges(const Bands& bands, std::size_t j) noexcept {
    const Girth behind = of_bands(bands, j);
    return {max(behind.rho, load4(&bands.rho[j])), max(behind.outward, load4(&bands.outward[j])),
            max(behind.inward, load4(&bands.inward[j]))};
}

/// Four cross-sections at one amplitude, sector by sector.
struct Sections {
    Float4 radius[sectors];   // the farthest vertex outward
    Float4 through[sectors];  // the deepest wrinkle inward
    Mask4 none;               // there is no vertex
    Float4 reach;             // the farthest vertex, whichever way its wrinkle goes
    bool deep;                // some wrinkle is deeper than the radius
};

Sections sections_of(const Girth& girth, Float4 amplitude) noexcept {
    Sections sections;
    for (int i = 0; i < sectors; ++i) {
        sections.radius[i] = girth.rho + splat(amplitude[i]) * girth.outward;
        sections.through[i] = splat(amplitude[i]) * girth.inward;
    }
    sections.none = girth.rho < splat(0);
    sections.reach = max(sections.radius[sectors - 1], girth.rho + sections.through[sectors - 1]);
    sections.deep = any(sections.through[sectors - 1] > girth.rho);
    return sections;
}

/// How far cross-sections extend along an axis, and against it.
struct Support {
    Float4 up, down;
};

/// `value` where the mask holds, else 0.
Float4 where(Mask4 holds, Float4 value) noexcept {
    return select(holds, value, splat(0));
}

/// The support of sections with these radii, which never decrease from sector to sector. (a, b) is the axis
/// in the plane of the section: a toward the bend, b >= 0 across; `whole` is its length. Each sector is an
/// arc, whose farthest point lies where the axis points, or at an end. Where two arcs meet, that of the inner
/// one is farther out.
inline Support support_of(const Float4 (&radius)[sectors], Float4 a, Float4 b, Float4 whole) noexcept {
    const Float4 half = splat(0.5f) * whole, slant = splat(0.8660254f) * b, middle = radius[2] * b;
    const auto toward = [&](Float4 c, Float4 half_c) {
        const Float4 outer = max(radius[0], where(c > -half, radius[1]));
        const Float4 inner = max(where(c > splat(0), radius[2]), where(c > half, radius[3]));
        const Float4 ends = max(radius[3] * max(c, slant + half_c), radius[1] * (slant - half_c));
        return max(max(ends, middle), max(outer, inner) * whole);
    };
    const Float4 half_a = splat(0.5f) * a;
    return {toward(a, half_a), toward(-a, -half_a)};
}

inline Support support_of(const Sections& sections, Float4 a, Float4 b, Float4 whole) noexcept {
    const Support outside = support_of(sections.radius, a, b, whole);
    if (!sections.deep) return outside;
    // Wrinkles deeper than the radius move vertices through the axis to its other side.
    const Support inside_out = support_of(sections.through, a, b, whole);
    return {max(outside.up, inside_out.down), max(outside.down, inside_out.up)};
}

/// The extent of a region along one axis of the streams' space. (m0, m1, m2) are the components of that axis
/// along n, b and t, over the largest of them, so that no square leaves float's range.
///
/// A band sweeps its widest cross-section along its piece of the arc. Each point of the section moves on a
/// circle. It is farthest at the beginning, at the end, or where it moves at a right angle to the axis, so
/// that only the sections at these places count.
class AxisExtent {
public:
    AxisExtent(const Coefficients& k, int row) noexcept
        : scale_(std::clamp(largest(k.matrix, row), 1e-36f, 1e36f)),
          m0_(k.matrix[row] / scale_),
          m2_(k.matrix[8 + row] / scale_),
          across_(splat(std::fabs(k.matrix[4 + row]) / scale_)) {
        // Takes the roots of a whole register: for two, compilers fill half of one, and trap on what is in
        // the other half.
        const float square = m0_ * m0_ + m2_ * m2_, both = square + across_[0] * across_[0];
        const Float4 roots = sqrt(Float4{square, both, square, both});
        in_plane_ = roots[0];
        whole_ = roots[1];
    }

    /// Takes the four edges from j on.
    void take_edges(const CenterLine& line, std::size_t j, const Sections& sections) noexcept {
        const Float4 at = splat(m0_) * line.x + splat(m2_) * line.z;
        const Float4 a = splat(m0_) * line.cosine - splat(m2_) * line.sine;
        store4(at_ + j, at);
        store4(a_ + j, a);
        store4(tau_ + j, splat(m0_) * line.sine + splat(m2_) * line.cosine);
        take(sections, at, a, sqrt(a * a + across_ * across_));
    }

    /// Takes the bands that run at a right angle to the axis somewhere, after all edges. `radius` and
    /// `sagitta` are those of the center line in a band.
    void take_bands(const Bands& bands, Float4 amplitude, float radius, float sagitta) noexcept {
        for (std::size_t j = 0; j < Bands::count; ++j) {
            if (!(tau_[j] * tau_[j + 1] < 0) || bands.rho[j + 1] < 0) continue;
            // From the nearer edge, so that little cancels.
            const std::size_t i = std::fabs(tau_[j]) < std::fabs(tau_[j + 1]) ? j : j + 1;
            const float arc_x =
                std::min(radius * tau_[i] * tau_[i] / (in_plane_ + std::fabs(a_[i])), sagitta * in_plane_);
            const float side = a_[i] > 0 ? 1.0f : -1.0f;
            const Girth girth = {splat(bands.rho[j + 1]), splat(bands.outward[j + 1]),
                                 splat(bands.inward[j + 1])};
            take(sections_of(girth, amplitude), splat(at_[i] - side * arc_x), splat(side * in_plane_),
                 splat(whole_));
        }
    }

    /// Takes four bands, each of which goes all around a circle of `radius`.
    void take_circles(const Sections& sections, float radius) noexcept {
        for (const float side : {-1.0f, 1.0f}) {
            take(sections, splat((m0_ - side * in_plane_) * radius), splat(side * in_plane_), splat(whole_));
        }
    }

    /// Length of the axis: the scale of the transform along it.
    [[nodiscard]] float whole() const noexcept { return scale_ * whole_; }
    [[nodiscard]] float low() const noexcept {
        return scale_ * std::min({low_[0], low_[1], low_[2], low_[3]});
    }
    [[nodiscard]] float high() const noexcept {
        return scale_ * std::max({high_[0], high_[1], high_[2], high_[3]});
    }

private:
    [[nodiscard]] static float largest(const float* matrix, int row) noexcept {
        return std::max({std::fabs(matrix[row]), std::fabs(matrix[4 + row]), std::fabs(matrix[8 + row])});
    }

    void take(const Sections& sections, Float4 at, Float4 a, Float4 whole) noexcept {
        const auto [up, down] = support_of(sections, a, across_, whole);
        high_ = select(sections.none, high_, max(high_, at + up));
        low_ = select(sections.none, low_, min(low_, at - down));
    }

    float scale_, m0_, m2_;
    Float4 across_;
    float in_plane_, whole_;
    // Of the center line: place, and the axis' parts across and along.
    float at_[edges], a_[edges], tau_[edges];
    Float4 low_ = splat(std::numeric_limits<float>::max());
    Float4 high_ = splat(std::numeric_limits<float>::lowest());
};

/// How far vertices may be from where the bands' drift puts them. `reach`: of vertices, from the center line.
float shift_of(const Bands& bands, const Coefficients& k, float reach) noexcept {
    const float along = k.curvature * bands.drift_error * k.arc_z[0];
    return 1.01f * along * (k.one_minus_kappa + k.curvature * reach);
}

/// The bounds of a region that has vertices. `amplitude`: by sectors.
Bounds bounds_of(const Bands& bands, const Coefficients& k, Float4 amplitude) noexcept {
    const float height = (bands.highest - bands.lowest) / static_cast<float>(Bands::count);
    const float longest = height + k.curvature * bands.max_drift_step;
    const float length = k.one_minus_kappa * k.arc_z[0] * longest;  // of a band's arc; arc_z[0] is L
    const float turn = k.curvature * k.arc_z[0] * longest;
    constexpr float least_turn = 1e-6f;  // below it a band's sagitta is lost in the margin
    const float radius = length / std::max(turn, least_turn);
    AxisExtent extents[3] = {AxisExtent(k, 0), AxisExtent(k, 1), AxisExtent(k, 2)};
    Float4 reaches = splat(0);  // of vertices, from the center line
    for (std::size_t j = 0; j < edges; j += 4) {
        if (turn > 3) {  // nearly half a turn: all of the circle
            const Sections sections = sections_of(of_bands(bands, j), amplitude);
            reaches = max(reaches, sections.reach);
            for (AxisExtent& extent : extents) extent.take_circles(sections, radius);
            continue;
        }
        const Float4 place = splat(static_cast<float>(j)) + Float4{0, 1, 2, 3};
        Float4 at = splat(bands.lowest) + place * splat(height);
        if (bands.shaped) at = at - splat(k.curvature) * load4(&bands.drift[j]);
        const CenterLine line = center_line(k, at);
        const Sections sections = sections_of(at_edges(bands, j), amplitude);
        reaches = max(reaches, sections.reach);
        for (AxisExtent& extent : extents) extent.take_edges(line, j, sections);
    }
    const float reach = std::max({reaches[0], reaches[1], reaches[2], reaches[3]});
    const float shift = shift_of(bands, k, reach);
    // Angles are rounded to steps of 6e-8 of themselves, by which what is far from the center line moves.
    const float rounding = 1e-5f * k.arc_z[0] + reach * (1e-6f + 2e-7f * k.curvature * k.arc_z[0]);
    Bounds bounds;
    for (int row = 0; row < 3; ++row) {
        AxisExtent& extent = extents[row];
        if (!(turn > 3)) extent.take_bands(bands, amplitude, radius, length * turn / 8);
        const float margin = (rounding + shift) * extent.whole() + 1e-6f * std::fabs(k.offset[row]);
        bounds.low[row] = k.offset[row] + extent.low() - margin;
        bounds.high[row] = k.offset[row] + extent.high() + margin;
    }
    return bounds;
}

Bounds nowhere() noexcept {
    constexpr float far = std::numeric_limits<float>::max();
    return {glm::vec3(far), glm::vec3(-far)};
}

Bounds bounds_of(const Body& body, std::span<const Pose> poses, const glm::mat4x3& transform, float weight,
                 Isa isa) noexcept {
    assert(!body.empty());
    const BodyData& data = *body.data();
    const PosedInstance posed(data, kernels(isa).setup, poses, transform, weight);
    return bounds_of(data, posed.k, posed.squeezes);
}

}  // namespace

Bounds bounds_of(const BodyData& body, const Coefficients* k, const Squeeze* squeezes) noexcept {
    Bounds bounds = nowhere();
    for (std::size_t r = 0; r < body.regions.size(); ++r) {
        if (body.regions[r].first == body.regions[r].last) continue;
        const Bounds own = bounds_of(body.details[r].bands, k[r], amplitudes(body, r, k, squeezes));
        bounds = {glm::min(bounds.low, own.low), glm::max(bounds.high, own.high)};
    }
    return bounds;
}

Bounds bounds(const Body& body, const Pose& pose, const glm::mat4x3& transform) noexcept {
    return bounds_of(body, {&pose, 1}, transform, 1, Isa::automatic);
}

Bounds bounds(const Body& body, std::span<const Pose> poses, const glm::mat4x3& transform) noexcept {
    return bounds_of(body, poses, transform, 1, Isa::automatic);
}

Bounds bounds(const DeformJob& job) noexcept {
    assert(job.body != nullptr && poses_of(job).size() == job.body->region_count());
    return bounds_of(*job.body, poses_of(job), job.transform, job.wrinkle_weight, job.isa);
}

void bounds(std::span<const DeformJob> jobs, std::span<Bounds> result) noexcept {
    assert(result.size() >= jobs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) result[i] = bounds(jobs[i]);
}

void bounds(const Batch& batch, std::span<Bounds> result, Isa isa) noexcept {
    assert(batch.body != nullptr && !batch.body->empty() && result.size() >= batch.count);
    const BodyData& body = *batch.body->data();
    const std::size_t regions = body.regions.size();
    constexpr std::size_t max_coefficients = 2 * max_regions;
    Coefficients k[max_coefficients];
    Squeeze squeezes[max_coefficients];
    const std::size_t together = std::min(max_coefficients / regions, setup_width);
    const Setup setup = kernels(isa).setup;
    const auto take = [&](PosedGroup& group, std::size_t first) {
        for (std::size_t r = 0; r < regions; ++r) {
            group.set_up(r, setup, false, k + r, regions);
            for (std::size_t i = 0; i < group.count(); ++i) squeezes[i * regions + r] = group.squeeze(i);
        }
        for (std::size_t i = 0; i < group.count(); ++i)
            result[first + i] = bounds_of(body, k + i * regions, squeezes + i * regions);
    };
    each_group(batch, body, Time::now, together, take);
}

}  // namespace goffer::bend
