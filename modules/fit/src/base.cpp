// SPDX-License-Identifier: MIT
#include "depth.hpp"

#include <goffer/fit/base.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace goffer::fit {
namespace {

double region_change(const Binding& binding, std::size_t region, double angle) {
    const double length = binding.regions[region].length, radius = binding.cylinder.radius;
    const int folds = binding.folds(region);
    if (folds == 0 || angle == 0) return -angle * radius / length;
    const double factor = binding.amplitude == Amplitude::area
                              ? paper::area_factor(binding.profile, folds, length, radius, angle)
                              : 1.0;
    return paper::lateral_area(binding.profile, folds, length, radius, angle, factor) - 1;
}

}  // namespace

std::optional<double> base_area_change(const Binding& binding, std::span<const double> angles) {
    const std::span<const bend::Region> regions = binding.body.regions();
    if (angles.size() != regions.size()) {
        throw Error("angles: " + std::to_string(angles.size()) + " for " + std::to_string(regions.size()) +
                    " regions; give one for each");
    }
    const bool gentle = std::ranges::any_of(regions, [](const bend::Region& r) { return r.onset != 0; });
    const bool shaped =
        std::ranges::any_of(binding.regions, [](const RegionBinding& r) { return r.shape != nullptr; });
    const bool joined =
        std::ranges::any_of(binding.regions, [](const RegionBinding& r) { return !r.wave.whole(); });
    if (gentle || shaped || joined || binding.cylinder.bent()) return std::nullopt;
    double change = 0;
    for (std::size_t r = 0; r < angles.size(); ++r) {
        change += binding.regions[r].length / binding.cylinder.length *
                  region_change(binding, r, std::fabs(angles[r]));
    }
    return change;
}

double wrinkle_depth(const Binding& binding, std::size_t region, double angle) {
    const RestRegion place = rest_regions(binding)[region];
    const double radius = place.shape ? place.shape->radius() : binding.cylinder.radius;
    const WrinkleDepth depth(place, radius, binding.profile, angle, place.length);
    if (!place.shape) return depth(0);
    constexpr int slices = 64;
    double deepest = 0;
    for (int i = 0; i <= slices; ++i) {
        const double z = place.length * i / slices;
        deepest = std::max(deepest, depth(z) / place.shape->scale(z));
    }
    return deepest * binding.cylinder.radius / radius;
}

}  // namespace goffer::fit
