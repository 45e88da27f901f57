// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wrinkle.hpp>

#include <vector>

/// How far a region with a shape can be bent.

namespace goffer::fit {

/// A slice of a region.
struct Girth {
    double scale;  ///< s: its radius over the region's
    double rho;    ///< largest distance of its vertices from the axis, at least its radius; model units
    double depth;  ///< largest displacement outward by a wrinkle of amplitude 1
};

/// A region's slices, from end to end.
struct Girths {
    double length, radius;
    std::vector<Girth> slices;
};

/// As largest_angle() in bind.hpp, with the largest of all slices.
[[nodiscard]] double largest_angle(const Girths& girths, paper::Profile profile, paper::Amplitude amplitude,
                                   paper::FoldRange folds, double factor);

}  // namespace goffer::fit
