// SPDX-License-Identifier: MIT
#pragma once

#include "rest.hpp"

#include <goffer/paper/wave.hpp>

#include <optional>

namespace goffer::fit {

/// How deep the troughs of a region are where the base is squeezed most. Counts from the straight body and
/// without an onset.
class WrinkleDepth {
public:
    /// The region is bent by `angle` over `length`, which may be that of more than the region. `radius`: of
    /// the base, where the region has no shape. Refers to the region's shape.
    WrinkleDepth(const RestRegion& region, double radius, Profile profile, double angle, double length);

    /// At height z of the region; model units.
    [[nodiscard]] double operator()(double z) const;

private:
    const paper::Shape* shape_;
    double kappa_, half_wave_;
    std::optional<paper::Wave> wave_;  // none without folds
};

}  // namespace goffer::fit
