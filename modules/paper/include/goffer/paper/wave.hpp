// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wrinkle.hpp>

#include <span>
#include <vector>

/// The wrinkle curve with its quadrature made ready, for those who solve eq 7 more than once. The functions
/// of wrinkle.hpp make a wave anew on every call; this one is made once and then shared.

namespace goffer::paper {

/// A wrinkled column as a fraction of the half length: its amplitude S a (eq 7), and how that grows with the
/// square root of the squeeze. In sqrt(q) the amplitude is smooth down to q = 0, where it starts as a
/// straight line.
struct Column {
    double amplitude = 0;  ///< S a = 2 A / L
    double slope = 0;      ///< d(S a) / d sqrt(q); 0 <= q, finite at 0
};

/// How fine a wave's quadrature is, relative to the length and the area that are computed with it.
enum class Accuracy {
    full,   ///< 1e-12 up to a squeeze of 0.999
    table,  ///< 1e-8 up to a squeeze of 0.99, at half the cost
};

/// The curve g(u) of one profile and number of folds, sampled for quadrature over u in 0..1. Immutable: any
/// number of threads may use one wave.
class Wave {
public:
    /// A quadrature node: the integral of F(u) over 0..1 is the sum of weight * F.
    struct Node {
        double weight;
        double shape;  ///< g(u)
        double slope;  ///< g'(u)
    };

    /// A wave that is fine enough for every squeeze in 0 <= q <= largest_squeeze < 1.
    /// Throws std::invalid_argument where folds < 1 or largest_squeeze is out of range.
    Wave(Profile profile, int folds, double largest_squeeze, Accuracy accuracy = Accuracy::full);

    /// Solves eq 7: see relative_amplitude in wrinkle.hpp.
    [[nodiscard]] double relative_amplitude(double squeeze) const;

    /// The column at `squeeze` (same domain and errors as relative_amplitude).
    [[nodiscard]] Column column(double squeeze) const;

    /// The nodes, in order of u. Valid as long as the wave.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

    /// Integrals of g(u)^2 and g'(u)^2 over u in 0..1.
    [[nodiscard]] double shape_power() const { return shape_power_; }
    [[nodiscard]] double slope_power() const { return slope_power_; }

private:
    std::vector<Node> nodes_;
    double shape_power_ = 0;
    double slope_power_ = 0;
};

}  // namespace goffer::paper
