// SPDX-License-Identifier: MIT
#include "rest.hpp"
#include "triangle.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/refine.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

constexpr std::size_t slices = 64;  // in which rows are looked at
constexpr double rounding = 1e-3;   // a mesh of just enough rows has enough

/// How far a triangle reaches along the axis, and its area.
struct Extent {
    double low, height;
    double area;
};

std::vector<Extent> extents(const Geometry& geometry, const Cylinder& cylinder) {
    const std::vector<double> z = heights(geometry.positions, cylinder);
    std::vector<Extent> all;
    all.reserve(geometry.triangles.size() / 3);
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const std::span<const std::uint32_t> corners = geometry.triangles.subspan(t, 3);
        const auto [low, high] = std::minmax({z[corners[0]], z[corners[1]], z[corners[2]]});
        all.push_back({low, high - low, Triangle(geometry.positions, corners).area()});
    }
    return all;
}

/// The extent that only the coarsest `share` of the area exceeds.
double extent_beyond(std::vector<Extent> all, double share) {
    std::ranges::sort(all, std::greater{}, &Extent::height);
    double area = 0;
    for (const Extent& r : all) area += r.area;
    double coarser = 0;
    for (const Extent& r : all) {
        coarser += r.area;
        if (coarser >= share * area) return r.height;
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

std::vector<glm::dvec3> places_on_base(const Cylinder& cylinder, std::span<const BasePoint> points) {
    std::vector<glm::dvec3> places;
    places.reserve(points.size());
    const Straightening straightening(cylinder);
    for (const BasePoint& point : points)
        places.push_back(straightening.bent({point.beta, point.z, point.rho}));
    return places;
}

Rows::Rows(const Geometry& geometry, const Cylinder& cylinder)
    : length_(cylinder.length), reach_(0), slices_(slices, 0) {
    const std::vector<Extent> all = extents(geometry, cylinder);
    std::vector<std::vector<Extent>> by_slice(slices);
    for (const Extent& extent : all) {
        const auto slice = [&](double z) {
            return static_cast<std::size_t>(std::clamp(z / length_ * slices, 0.0, slices - 1.0));
        };
        const std::size_t first = slice(extent.low), last = slice(extent.low + extent.height);
        for (std::size_t i = first; i <= last; ++i) by_slice[i].push_back(extent);
    }
    for (std::size_t i = 0; i < slices; ++i) {
        // Between separate parts there is nothing to look at: as below it.
        const bool gap = by_slice[i].empty() && i > 0;
        slices_[i] = gap ? slices_[i - 1] : extent_beyond(std::move(by_slice[i]), 0.05);
    }
    reach_ = extent_beyond(all, 0.02);
}

double Rows::reach_at(double z) const {
    const double at = std::clamp(z / length_ * slices - 0.5, 0.0, slices - 1.0);
    const auto i = static_cast<std::size_t>(at);
    return std::max(slices_[i], slices_[std::min<std::size_t>(i + 1, slices - 1)]);
}

double Rows::even_folds(double low, double high) const {
    constexpr int steps = 64;
    const double step = (high - low) / steps;
    double folds = 0;
    for (int i = 0; i < steps; ++i)
        folds += step / (rows_of_fold * std::max(reach_at(low + (i + 0.5) * step), 1e-9 * length_));
    return folds;
}

int Rows::folds(paper::Profile profile, double low, double high) const {
    const bool even = profile.kind == paper::Profile::Kind::even;
    const double folds = even ? even_folds(low, high) : (high - low) / (2 * rows_of_fold * reach_);
    return static_cast<int>(std::min<double>(folds * (1 + rounding), Stretch::max_folds));
}

int folds_capacity(const Geometry& geometry, const Cylinder& cylinder) {
    return Rows(geometry, cylinder).folds(Profile::damped, 0, cylinder.length);
}

int sensible_folds(const Cylinder& cylinder, int capacity, std::optional<double> fold_length) {
    const double long_folds = std::round(cylinder.length / (2 * cylinder.radius * fold_length.value_or(1)));
    const double folds = std::min<double>(long_folds, Stretch::max_folds);
    const int wanted = static_cast<int>(folds);
    return 2 * std::int64_t{capacity} < wanted ? 0 : std::min(wanted, std::max(capacity, 0));
}

}  // namespace goffer::fit
