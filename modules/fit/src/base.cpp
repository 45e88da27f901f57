// SPDX-License-Identifier: MIT
#include <goffer/fit/base.hpp>
#include <goffer/paper/wave.hpp>

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
    if (gentle || shaped || joined || binding.cylinder.rest_angle != 0) return std::nullopt;
    double change = 0;
    for (std::size_t r = 0; r < angles.size(); ++r) {
        change += binding.regions[r].length / binding.cylinder.length *
                  region_change(binding, r, std::fabs(angles[r]));
    }
    return change;
}

double wrinkle_depth(const Binding& binding, std::size_t region, double angle) {
    const double length = binding.regions[region].length;
    const paper::FoldRange folds = binding.regions[region].wave;
    if (folds.count == 0) return 0;
    const double wave_length = folds.wave_length(length);
    constexpr double most = 0.999;  // of eq 7's domain; the largest angle is below it
    const auto& shape = binding.regions[region].shape;
    const double radius = shape ? shape->radius() : binding.cylinder.radius;
    const double per_scale = 2 * std::fabs(angle) * radius / length;
    const double trough = binding.profile.trough();
    if (!shape)
        return trough *
               paper::amplitude(binding.profile, folds.total, wave_length, std::min(per_scale, most));
    const paper::Wave wave(binding.profile, folds.total, std::min(per_scale * shape->max_scale(), most));
    constexpr int slices = 64;
    double deepest = 0;
    for (int i = 0; i <= slices; ++i) {
        const double z = length * i / slices, scale = shape->scale(z);
        const double amplitude = wave.column(std::min(per_scale * scale, most)).amplitude * wave_length / 2;
        deepest = std::max(deepest, trough * amplitude * shape->depth(z) / scale);
    }
    return deepest * binding.cylinder.radius / radius;
}

}  // namespace goffer::fit
