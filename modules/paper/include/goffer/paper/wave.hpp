// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wrinkle.hpp>

#include <span>
#include <vector>

/// The wrinkle curve with its quadrature, for callers that solve eq 7 more than once. The functions of
/// wrinkle.hpp make a wave on every call.
/// See modules/paper/README.md, "Wrinkle".

namespace goffer::paper {

/// The wrinkle of a column, as a fraction of the half length. In sqrt(q) the amplitude is smooth down to
/// q = 0, where it starts as a straight line.
struct Column {
    double amplitude = 0;  ///< S a = 2 A / L (eq 7)
    double slope = 0;      ///< d(S a) / d sqrt(q), finite at q = 0
};

/// How fine the quadrature of a wave is: the relative error of the lengths and areas that are computed with
/// it.
enum class Accuracy {
    full,   ///< 1e-12 up to a squeeze of 0.999
    table,  ///< 1e-8 up to a squeeze of 0.99, with fewer nodes
};

/// The curve g(u) of one profile and number of folds, sampled for quadrature over u in 0..1. Immutable;
/// thread-safe.
class Wave {
public:
    /// A node of the quadrature: the integral of F(g, g'^2) over u in 0..1 is the sum of weight * F. With
    /// Profile::even, one half fold stands for all that are alike.
    struct Node {
        double weight;
        double shape;  ///< g(u)
        double slope;  ///< g'(u)
    };

    /// Makes a wave that has `accuracy` for squeezes up to `largest_squeeze`.
    /// Throws std::invalid_argument if folds < 1, the profile's roundness is not in 0..0.5, or
    /// largest_squeeze is not in 0 <= q < 1.
    Wave(Profile profile, int folds, double largest_squeeze, Accuracy accuracy = Accuracy::full);

    /// Solves eq 7 for the relative amplitude a, as relative_amplitude() in wrinkle.hpp does. Above
    /// largest_squeeze the result is less accurate. Throws std::invalid_argument if `squeeze` is not in
    /// 0 <= q < 1.
    [[nodiscard]] double relative_amplitude(double squeeze) const;

    /// Returns the wrinkle of the column at `squeeze`. Domain and errors as relative_amplitude().
    [[nodiscard]] Column column(double squeeze) const;

    /// Returns the nodes, valid as long as the wave.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

    /// Return the integrals of g(u)^2 and of g'(u)^2 over u in 0..1.
    [[nodiscard]] double shape_power() const { return shape_power_; }
    [[nodiscard]] double slope_power() const { return slope_power_; }

private:
    std::vector<Node> nodes_;
    double shape_power_ = 0;
    double slope_power_ = 0;
};

}  // namespace goffer::paper
