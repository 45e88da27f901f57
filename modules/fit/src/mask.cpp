// SPDX-License-Identifier: MIT
#include "mask.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace goffer::fit {
namespace {

/// The way from one vertex to another over the unrolled cylinder, and how much the mask changes on it.
struct Step {
    double beta, z, mask;

    Step(const Geometry& geometry, std::span<const paper::Cylindrical> at, std::uint32_t from,
         std::uint32_t to)
        : beta(std::remainder(at[to].beta - at[from].beta, 2 * std::numbers::pi)),
          z(at[to].z - at[from].z),
          mask(static_cast<double>(geometry.wrinkle_mask[to]) -
               static_cast<double>(geometry.wrinkle_mask[from])) {}
};

}  // namespace

// The mask is linear over each triangle; a vertex has the mean over its triangles, by their areas on the
// unrolled cylinder. The ends of a body have none there, and do not count.
Mask::Mask(const Geometry& geometry, std::span<const paper::Cylindrical> at) : mask_(geometry.wrinkle_mask) {
    if (mask_.empty()) return;
    slopes_.resize(mask_.size());
    std::vector<double> areas(mask_.size());
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const auto corners = geometry.triangles.subspan(t, 3);
        const Step a(geometry, at, corners[0], corners[1]), b(geometry, at, corners[0], corners[2]);
        const double area = a.beta * b.z - b.beta * a.z;
        const double slope = a.beta * b.mask - b.beta * a.mask;  // times the area
        for (const std::uint32_t corner : corners) {
            slopes_[corner] += std::copysign(1.0, area) * slope;
            areas[corner] += std::fabs(area);
        }
    }
    for (std::size_t i = 0; i < slopes_.size(); ++i) slopes_[i] = areas[i] > 0 ? slopes_[i] / areas[i] : 0;
}

void Mask::apply(std::size_t i, bend::RestVertex& vertex) const {
    if (mask_.empty()) return;
    const double mask = static_cast<double>(mask_[i]);
    vertex.slope = mask * vertex.slope + slopes_[i] * vertex.wrinkle * vertex.rho;
    vertex.wrinkle *= mask;
}

bool may_wrinkle(const Geometry& geometry, std::span<const std::uint32_t> corners) {
    if (geometry.wrinkle_mask.empty()) return true;
    float sum = 0;
    for (const std::uint32_t corner : corners) sum += geometry.wrinkle_mask[corner];
    return 2 * sum >= static_cast<float>(corners.size());
}

}  // namespace goffer::fit
