// SPDX-License-Identifier: MIT
#include "depth.hpp"

#include <algorithm>
#include <cmath>

namespace goffer::fit {
namespace {

constexpr double most_squeeze = 0.999;  // of eq 7's domain; the largest angle is below it

}  // namespace

WrinkleDepth::WrinkleDepth(const RestRegion& region, double radius, Profile profile, double angle,
                           double length)
    : shape_(region.shape.get()),
      kappa_(std::fabs(angle) * (shape_ != nullptr ? shape_->radius() : radius) / length),
      half_wave_(profile.trough() * region.folds.wave_length(region.length) / 2) {
    const double max_scale = shape_ != nullptr ? shape_->max_scale() : 1;
    if (region.folds.count > 0)
        wave_.emplace(profile, region.folds.total, std::min(2 * kappa_ * max_scale, most_squeeze));
}

double WrinkleDepth::operator()(double z) const {
    if (!wave_) return 0;
    const double scale = shape_ != nullptr ? shape_->scale(z) : 1;
    return half_wave_ * wave_->column(std::min(2 * kappa_ * scale, most_squeeze)).amplitude *
           paper::wave_depth(shape_, z);
}

}  // namespace goffer::fit
