// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wrinkle.hpp>

#include <vector>

/// How a body differs from a cylinder along its length: its radius, how long its folds are, and where they
/// fade. See modules/paper/README.md, "Shaped bodies". All functions are thread-safe.

namespace goffer::paper {

/// A smooth function of z in 0..length: the uniform cubic B-spline of control values at equal steps from end
/// to end, straight (without curvature) at both. It stays within the range of its values, and those that lie
/// on a straight line are met. Immutable.
class Spline {
public:
    /// Throws std::invalid_argument if length is not a finite number above 0, there are fewer than two
    /// values, or one is not finite.
    Spline(double length, std::vector<double> values);

    /// Return the value, the derivative by z, and the integral from 0 to z. z outside 0..length counts as the
    /// nearer end.
    [[nodiscard]] double operator()(double z) const;
    [[nodiscard]] double slope(double z) const;
    [[nodiscard]] double integral(double z) const;

    /// Returns the mean over the length.
    [[nodiscard]] double mean() const { return sums_.back() / length_; }

    /// Returns the largest value, or 0 where all are less.
    [[nodiscard]] double largest() const;

    [[nodiscard]] double length() const { return length_; }

private:
    double length_;
    double step_;
    std::vector<double> values_;  // one more at either end
    std::vector<double> sums_;    // integrals from 0 to each step
};

/// The shape of one region. Immutable.
class Shape {
public:
    /// What is given of a shape: control values at equal steps from z = 0 to the region's end. Any number of
    /// them, two or more.
    struct Knots {
        std::vector<double> radius = {};  ///< r(z) > 0, model units; empty: the radius is the same throughout
        std::vector<double> fold_length = {};  ///< > 0, in any unit: only ratios count; empty: r(z)
        std::vector<double> weight = {};       ///< 0..4, a factor on the wrinkle; empty: 1
    };

    /// `radius`: of the cylinder, > 0, for a shape that gives no radii; not looked at otherwise. Throws
    /// std::invalid_argument as Spline does, and if a value is out of its range.
    Shape(double length, double radius, const Knots& knots);

    /// Returns the knots that it was made from.
    [[nodiscard]] const Knots& knots() const { return knots_; }

    /// Returns the mean of r(z), which is the radius of the region's base cylinder.
    [[nodiscard]] double radius() const { return mean_; }

    /// Returns the largest r(z) / radius().
    [[nodiscard]] double max_scale() const { return max_scale_; }

    /// Returns how many folds there are from end to end if they are as long as fold_length says, in model
    /// units.
    [[nodiscard]] double folds() const { return folds_.back(); }

    /// Return s = r(z) / radius(), and ds/dz.
    [[nodiscard]] double scale(double z) const { return round_ ? 1 : radius_(z) / mean_; }
    [[nodiscard]] double scale_slope(double z) const { return round_ ? 0 : radius_.slope(z) / mean_; }

    /// Returns D(z), the integral of r - radius() from 0 to z; model units squared. It is 0 at both ends.
    [[nodiscard]] double drift(double z) const;

    /// Returns z of the place whose arc angle is that of height `arc_z` on a cylinder: the inverse of z -
    /// curvature D(z), where `curvature` = alpha / L. Beyond the ends it is `arc_z` itself.
    [[nodiscard]] double unshifted(double arc_z, double curvature) const;

    /// Return the shape g of the wrinkle at z, and dg/dz: folds are as long as fold_length says, and as deep
    /// in proportion.
    [[nodiscard]] double wave(Profile profile, FoldRange folds, double z) const;
    [[nodiscard]] double wave_slope(Profile profile, FoldRange folds, double z) const;

    /// Returns what the wave is multiplied by at z: the length of the fold over the mean of all, times the
    /// weight.
    [[nodiscard]] double depth(double z) const;

private:
    /// The integral of 1 / fold_length from `low` to `high`.
    [[nodiscard]] double folds_between(double low, double high) const;
    /// The share of all folds that is before z.
    [[nodiscard]] double folds_share(double z) const;
    [[nodiscard]] double depth_slope(double z) const;

    Knots knots_;
    Spline radius_, fold_length_, weight_;
    bool round_;  // no radii were given: a cylinder, exactly
    double mean_, max_scale_;
    std::vector<double> folds_;  // integrals of 1 / fold_length from 0 to equal steps
};

/// Returns shape->depth(z), or 1 where there is no shape.
[[nodiscard]] inline double wave_depth(const Shape* shape, double z) {
    return shape != nullptr ? shape->depth(z) : 1;
}

/// The shape g of a wrinkle at a height, and dg/dz.
struct WaveAt {
    double shape, slope;
};

/// Returns g and dg/dz at height z of a region of `length`: of its own shape, or of one length of folds where
/// `shape` is null.
[[nodiscard]] WaveAt wave_at(const Shape* shape, Profile profile, FoldRange folds, double length, double z);

}  // namespace goffer::paper
