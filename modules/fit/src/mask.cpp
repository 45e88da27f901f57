// SPDX-License-Identifier: MIT
#include "mask.hpp"

#include "places.hpp"

#include <cmath>
#include <numbers>

namespace goffer::fit {
namespace {

/// The way from one vertex to another over the unrolled cylinder, and how much the mask changes on it.
struct Step {
    double beta, z, mask;

    Step(std::span<const paper::Cylindrical> at, std::span<const float> values, std::uint32_t from,
         std::uint32_t to)
        : beta(std::remainder(at[to].beta - at[from].beta, 2 * std::numbers::pi)),
          z(at[to].z - at[from].z),
          mask(static_cast<double>(values[to]) - static_cast<double>(values[from])) {}
};

}  // namespace

// The mask is linear over each triangle. A vertex, and all others in its place, gets the mean over the
// triangles there, by their areas on the unrolled cylinder. The ends of a body have none on it, and do not
// count.
Mask::Mask(const Geometry& geometry, const Cylinder& cylinder) : mask_(geometry.wrinkle_mask) {
    if (mask_.empty()) return;
    const Straightening straightening(cylinder);
    std::vector<paper::Cylindrical> at;
    at.reserve(mask_.size());
    for (const glm::vec3& position : geometry.positions) at.push_back(straightening.vertex(position));
    const std::vector<std::uint32_t> place = places(geometry.positions);
    std::vector<double> sums(mask_.size()), areas(mask_.size());
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const auto corners = geometry.triangles.subspan(t, 3);
        const Step a(at, mask_, corners[0], corners[1]), b(at, mask_, corners[0], corners[2]);
        const double area = a.beta * b.z - b.beta * a.z;
        const double slope = a.beta * b.mask - b.beta * a.mask;  // times the area
        for (const std::uint32_t corner : corners) {
            sums[place[corner]] += std::copysign(1.0, area) * slope;
            areas[place[corner]] += std::fabs(area);
        }
    }
    slopes_.reserve(mask_.size());
    for (const std::uint32_t own : place) slopes_.push_back(areas[own] > 0 ? sums[own] / areas[own] : 0);
}

void apply(const MaskValue& mask, bend::RestVertex& vertex) {
    vertex.slope = mask.value * vertex.slope + mask.slope * vertex.wrinkle * vertex.rho;
    vertex.wrinkle *= mask.value;
}

void apply_mask(const Geometry& geometry, const Cylinder& cylinder, RestMesh& mesh) {
    const Mask mask(geometry, cylinder);
    if (mask.empty()) return;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        apply(mask.at(mesh.order.empty() ? i : mesh.order[i]), mesh.vertices[i]);
}

bool may_wrinkle(const Geometry& geometry, std::span<const std::uint32_t> corners) {
    if (geometry.wrinkle_mask.empty()) return true;
    float sum = 0;
    for (const std::uint32_t corner : corners) sum += geometry.wrinkle_mask[corner];
    return 2 * sum >= static_cast<float>(corners.size());
}

}  // namespace goffer::fit
