// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"
#include "pose/center_line.hpp"
#include "pose/posed_group.hpp"

#include <goffer/bend/capsules.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace goffer::bend {

using namespace simd;

namespace {

/// The largest distance from the center line of vertices between two heights (of z / L - 1/2).
float widest(const Bands& bands, float amplitude, float from, float to) noexcept {
    const float height = (bands.highest - bands.lowest) / static_cast<float>(Bands::count);
    float radius = 0;
    for (std::size_t j = 0; j < Bands::count; ++j) {
        // Counts a band's width before and behind each band, since rounding may put a vertex in its neighbor.
        const float low = bands.lowest + (static_cast<float>(j) - 1) * height;
        const bool apart = low > to || low + 3 * height < from;
        if (apart || bands.rho[j + 1] < 0) continue;
        // A wrinkle may move a vertex of any rho, also of 0, through the axis.
        radius = std::max(
            {radius, bands.rho[j + 1] + amplitude * bands.outward[j + 1], amplitude * bands.inward[j + 1]});
    }
    return radius;
}

/// Where the arc has the angle of height v = z / L - 1/2: v itself, without a shape.
float shifted(const Bands& bands, const Coefficients& k, float v) noexcept {
    return v - k.curvature * drift_at(bands, (v - bands.lowest) * bands_per_height(bands));
}

/// An upper bound for the factor that the linear part M of `transform` stretches vectors by: the root of the
/// largest sum of absolute values in a row of M^T M.
float largest_scale(const glm::mat4x3& transform) noexcept {
    float largest = 0;
    for (int i = 0; i < 3; ++i) {
        float sum = 0;
        for (int j = 0; j < 3; ++j) {
            float product = 0;
            for (int row = 0; row < 3; ++row) product += transform[i][row] * transform[j][row];
            sum += std::fabs(product);
        }
        largest = std::max(largest, sum);
    }
    return std::sqrt(largest);
}

glm::vec3 placed(const Coefficients& k, const CenterLine& line, int i) noexcept {
    glm::vec3 point;
    for (int row = 0; row < 3; ++row)
        point[row] = k.offset[row] + k.matrix[row] * line.x[i] + k.matrix[8 + row] * line.z[i];
    return point;
}

void region_capsules(const Region& region, const Bands& bands, const Coefficients& k, float deepest,
                     float scale, std::span<Capsule> result) {
    constexpr float margin = 1.00001f;  // for rounding
    const float count = static_cast<float>(result.size());
    const float step = (bands.highest - bands.lowest) / count;
    const float slack = k.curvature * bands.drift_error;
    // Coordinates are rounded to steps of 6e-8 of themselves.
    const float rounding = 1e-6f * (scale * region.length + std::fabs(k.offset[0]) + std::fabs(k.offset[1]) +
                                    std::fabs(k.offset[2]));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float from = bands.lowest + step * static_cast<float>(i);
        const float begin = shifted(bands, k, from), end = shifted(bands, k, from + step);
        const float height = end - begin + 2 * slack;
        const float turn = k.curvature * region.length * height;
        const float arc = k.one_minus_kappa * region.length * height;
        // R (1 - cos(turn / 2)) is at most R turn^2 / 8; beyond about half a turn the arc's length is the
        // bound.
        const float sagitta = (turn < 3 ? arc * turn / 8 : arc) + k.one_minus_kappa * region.length * slack;
        const CenterLine line = center_line(k, Float4{begin, end, begin, begin});
        const float radius =
            region.first == region.last
                ? 0
                : scale * margin * (widest(bands, deepest, from, from + step) + sagitta) + rounding;
        result[i] = {placed(k, line, 0), placed(k, line, 1), radius};
    }
}

}  // namespace

void capsules(const DeformJob& job, std::size_t pieces, std::span<Capsule> result) noexcept {
    assert(job.body != nullptr && !job.body->empty() && pieces >= 1);
    assert(poses_of(job).size() == job.body->region_count());
    assert(result.size() >= capsule_count(*job.body, pieces));
    const BodyData& body = *job.body->data();
    const float scale = largest_scale(job.transform);
    const PosedInstance posed(body, kernels(job.isa).setup, poses_of(job), job.transform, job.wrinkle_weight);
    for (std::size_t r = 0; r < body.regions.size(); ++r) {
        const float deepest = amplitudes(body, r, posed.k, posed.squeezes)[sectors - 1];
        region_capsules(body.regions[r], body.details[r].bands, posed.k[r], deepest, scale,
                        result.subspan(r * pieces, pieces));
    }
}

}  // namespace goffer::bend
