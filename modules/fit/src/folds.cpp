// SPDX-License-Identifier: MIT
#include "rest.hpp"

#include <goffer/fit/cylinder.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

constexpr int max_folds = 1 << 20;  // far beyond any use, well inside int

/// How far a triangle reaches along the axis, and its area.
using Reach = std::pair<double, double>;

std::vector<Reach> reaches(const Geometry& geometry, const Cylinder& cylinder) {
    const std::vector<double> z = heights(geometry.positions, cylinder);
    std::vector<Reach> all;
    all.reserve(geometry.triangles.size() / 3);
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const std::uint32_t i = geometry.triangles[t], j = geometry.triangles[t + 1],
                            k = geometry.triangles[t + 2];
        const glm::dvec3 a(geometry.positions[i]), b(geometry.positions[j]), c(geometry.positions[k]);
        const auto [low, high] = std::minmax({z[i], z[j], z[k]});
        all.emplace_back(high - low, glm::length(glm::cross(b - a, c - a)) / 2);
    }
    return all;
}

/// The reach that only the coarsest `share` of the area exceeds.
double reach_beyond(std::vector<Reach> all, double share) {
    std::ranges::sort(all, std::greater{});
    double area = 0;
    for (const Reach& r : all) area += r.second;
    double coarser = 0;
    for (const Reach& r : all) {
        coarser += r.second;
        if (coarser >= share * area) return r.first;
    }
    return 0;
}

}  // namespace

std::vector<double> heights(std::span<const glm::vec3> positions, const Cylinder& cylinder) {
    std::vector<double> z;
    z.reserve(positions.size());
    const Straightening straightening(cylinder);
    for (const glm::vec3& position : positions) z.push_back(straightening.height(position));
    return z;
}

Rows::Rows(const Geometry& geometry, const Cylinder& cylinder)
    : reach_(reach_beyond(reaches(geometry, cylinder), 0.02)) {}

int Rows::folds(double length) const {
    constexpr double rows_per_length = 16;  // 8 a fold, k folds per half length
    constexpr double rounding = 1e-3;       // a mesh of just enough rows has enough
    const double folds = (1 + rounding) * length / (rows_per_length * reach_);
    return folds < max_folds ? static_cast<int>(folds) : max_folds;
}

int folds_capacity(const Geometry& geometry, const Cylinder& cylinder) {
    return Rows(geometry, cylinder).folds(cylinder.length);
}

int sensible_folds(const Cylinder& cylinder, int capacity) {
    const double folds = std::min<double>(std::round(cylinder.length / (2 * cylinder.radius)), max_folds);
    const int wanted = static_cast<int>(folds);
    return 2 * std::int64_t{capacity} < wanted ? 0 : std::min(wanted, std::max(capacity, 0));
}

}  // namespace goffer::fit
