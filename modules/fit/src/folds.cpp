// SPDX-License-Identifier: MIT
#include <goffer/fit/cylinder.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace goffer::fit {
namespace {

constexpr int most_folds = 1 << 20;  // far beyond any use, well inside int

/// How far a triangle reaches along the axis, and its area.
using Reach = std::pair<double, double>;

std::vector<Reach> reaches(const Geometry& geometry, const Cylinder& cylinder) {
    std::vector<Reach> all;
    all.reserve(geometry.triangles.size() / 3);
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(geometry.positions[geometry.triangles[t + i]]) - cylinder.origin;
        };
        const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
        const auto [low, high] =
            std::minmax({glm::dot(a, cylinder.axis), glm::dot(b, cylinder.axis), glm::dot(c, cylinder.axis)});
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

int folds_capacity(const Geometry& geometry, const Cylinder& cylinder) {
    constexpr double left_out = 0.02;
    constexpr double rows_per_length = 16;  // 8 a fold, k folds per half length
    constexpr double rounding = 1e-3;       // a mesh of just enough rows has enough
    const double reach = reach_beyond(reaches(geometry, cylinder), left_out);
    const double folds = (1 + rounding) * cylinder.length / (rows_per_length * reach);
    return folds < most_folds ? static_cast<int>(folds) : most_folds;
}

int sensible_folds(const Cylinder& cylinder, int capacity) {
    const double folds = std::min<double>(std::round(cylinder.length / (2 * cylinder.radius)), most_folds);
    const int wanted = static_cast<int>(folds);
    return 2 * std::int64_t{capacity} < wanted ? 0 : std::min(wanted, std::max(capacity, 0));
}

}  // namespace goffer::fit
