// SPDX-License-Identifier: MIT
#include "factors.hpp"
#include "poser.hpp"
#include "rest.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Factors along the body, of Amplitude::mesh.

namespace goffer::fit {
namespace {

constexpr double most_slice = 1.5;  // factor of a slice

/// A triangle's share in the slices about two neighboring knots.
struct Slice {
    std::size_t first;
    double next;  // share of the slice behind `first`; the rest is that of `first`
};

/// Areas of slices, each a sum over triangles.
using SliceAreas = std::vector<double>;

/// Factors along z, in what they change.
class SliceSolver {
public:
    /// The slices lie between the heights `low` and `high`.
    SliceSolver(std::span<const std::uint32_t> triangles, std::span<const double> heights, double low,
                double high, std::size_t knots)
        : triangles_(triangles), knots_(knots) {
        const auto [first, last] = std::ranges::minmax(triangles);
        first_used_ = first;
        last_used_ = last;
        const auto slice = [&](double z) { return slice_at((z - low) / (high - low)); };
        for (const double z : heights) places_.push_back(slice(z));
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const double z = heights[triangles[t]] + heights[triangles[t + 1]] + heights[triangles[t + 2]];
            slices_.push_back(slice(z / 3));
        }
    }

    /// Adds the areas of the slices with the wrinkle times `factors`.
    void add_areas(const Surface& surface, std::span<const double> factors, SliceAreas& areas) const {
        std::vector<glm::vec3> at(surface.bare.size());
        for (std::size_t i = first_used_; i <= last_used_; ++i) {
            const Slice& place = places_[i];
            const double factor =
                factors[place.first] + place.next * (factors[place.first + 1] - factors[place.first]);
            at[i] = surface.bare[i] + static_cast<float>(factor) * surface.wrinkle[i];
        }
        for (std::size_t t = 0; t < triangles_.size(); t += 3) {
            const glm::vec3 u = at[triangles_[t + 1]] - at[triangles_[t]];
            const glm::vec3 v = at[triangles_[t + 2]] - at[triangles_[t]];
            const double area = static_cast<double>(glm::length(glm::cross(u, v))) / 2;
            const Slice& slice = slices_[t / 3];
            areas[slice.first] += (1 - slice.next) * area;
            areas[slice.first + 1] += slice.next * area;
        }
    }

private:
    [[nodiscard]] Slice slice_at(double share) const {
        const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(knots_ - 1);
        const auto first = std::min(static_cast<std::size_t>(at), knots_ - 2);
        return {first, at - static_cast<double>(first)};
    }

    std::span<const std::uint32_t> triangles_;
    std::uint32_t first_used_, last_used_;  // vertices
    std::size_t knots_;
    std::vector<Slice> places_, slices_;  // of vertices; of triangles
};

/// A better factor for a slice that gains `gain` area by `factor` and is `missing` so much without a wrinkle.
double next_factor(double factor, double gain, double missing, double area) {
    constexpr double least_gain = 2e-3;  // of the area, below which a factor says nothing
    if (missing <= 0) {
        factor *= 0.5;
    } else if (gain > least_gain * area) {
        factor *= std::clamp(std::sqrt(missing / gain), 0.6, 1.4);  // area is nearly linear in the square
    }
    return std::clamp(factor, 0.0, most_slice);
}

/// The poses in which slices are to keep their area: far, but not as far as the body can be bent. One that is
/// bent at rest is bent further.
std::vector<bend::Pose> slice_poses(const bend::Body& body, std::size_t region) {
    constexpr int directions = 8;
    const bend::Pose rest = body.rest_pose(region);
    const float largest = body.max_angle(region);
    std::vector<bend::Pose> poses;
    if (rest.angle != 0) {
        for (const float turn : {-0.5f, 0.0f, 0.5f})
            poses.push_back({rest.angle + 0.5f * (largest - rest.angle), rest.direction + turn});
        return poses;
    }
    const float angle = std::min(0.6f * largest, std::numbers::pi_v<float> / 2);
    for (int i = 0; i < directions; ++i)
        poses.push_back({angle, 2 * std::numbers::pi_v<float> * static_cast<float>(i) / directions});
    return poses;
}

}  // namespace

std::vector<double> solve_weights(const bend::Body& body, const Geometry& geometry,
                                  std::span<const std::uint32_t> order, std::span<const double> heights,
                                  std::size_t region, int folds, const Share& share) {
    constexpr std::size_t steps = 6;
    // Two folds apart at least: a slice that is shorter than a fold would follow its crest and trough.
    const auto knots = static_cast<std::size_t>(std::clamp(folds / 2 + 1, 3, 13));
    const std::vector<std::uint32_t> triangles =
        triangles_of(body.regions()[region], geometry.triangles, places_in_body(order));
    if (body.region_inputs()[region].table.empty() || triangles.empty()) return {};
    double low = 0;
    for (std::size_t r = 0; r < region; ++r) low += body.region_inputs()[r].length;
    const SliceSolver solver(triangles, heights, low, low + body.region_inputs()[region].length, knots);
    std::vector<Surface> surfaces;
    const std::vector<double> none(knots, 0);
    std::vector<double> factors(knots, 1);
    SliceAreas wanted(knots), bare(knots);
    Poser poser(body, triangles);
    const Surface at_rest = poser.rest();
    const std::vector<bend::Pose> poses = slice_poses(body, region);
    for (const bend::Pose& pose : poses) {
        poser.bend(region, pose, surfaces.emplace_back());
        solver.add_areas(at_rest, none, wanted);
        solver.add_areas(surfaces.back(), none, bare);
        share.step(0, 2).tell(surfaces.size(), poses.size());
    }
    for (std::size_t step = 0; step < steps; ++step) {
        SliceAreas now(knots);
        for (const Surface& surface : surfaces) solver.add_areas(surface, factors, now);
        for (std::size_t i = 0; i < knots; ++i)
            factors[i] = next_factor(factors[i], now[i] - bare[i], wanted[i] - bare[i], wanted[i]);
        share.step(1, 2).tell(step + 1, steps);
    }
    return factors;
}

}  // namespace goffer::fit
