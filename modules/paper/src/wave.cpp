// SPDX-License-Identifier: MIT
#include "goffer/paper/wave.hpp"

#include "quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace goffer::paper {
namespace {

void require_folds(int folds) {
    if (folds < 1) {
        throw std::invalid_argument("folds is " + std::to_string(folds) + ": a wrinkle needs 1 or more");
    }
}

void require_squeeze(double squeeze) {
    if (!(squeeze >= 0 && squeeze < 1)) {
        throw std::invalid_argument(
            "squeeze is " + std::to_string(squeeze) +
            ": it must be 0 or more and below 1 (bend by less than length / (2 radius))");
    }
}

void require_roundness(double roundness) {
    if (!(roundness >= 0 && roundness <= 0.5)) {
        throw std::invalid_argument("roundness is " + std::to_string(roundness) + ": it must be 0 to 0.5");
    }
}

/// The zero of g' between `low` and `high`, of which it changes its sign once.
double extremum(Profile profile, int folds, double low, double high) {
    const bool rises = shape_slope(profile, folds, low) > 0;
    for (int step = 0; step < 40; ++step) {
        const double middle = (low + high) / 2;
        ((shape_slope(profile, folds, middle) > 0) == rises ? low : high) = middle;
    }
    return low;
}

// g' vanishes once shortly before each multiple j of a half wave, j = 1 .. 2k. How far before is tan(v) = 1 /
// ((1 - u) w) for `damped` and 4 u / ((1 - u^2) w) for `smooth`, both below 1.3 rad.
std::vector<double> extrema_before_half_waves(Profile profile, int folds) {
    const double frequency = 2 * std::numbers::pi * folds;
    std::vector<double> found;
    for (int j = 1; j <= 2 * folds; ++j) {
        const double half_wave = j * std::numbers::pi;
        found.push_back(extremum(profile, folds, (half_wave - 1.3) / frequency, half_wave / frequency));
    }
    return found;
}

// The extrema of half a fold of `even`, from u = `low` to low + 1 / k. The fade moves those of the end folds,
// and a roundness above 1/4 makes more of them: they are looked for. Between two of them there is a place
// where g' is steepest, which the quarters of a fold are near to.
std::vector<double> extrema_of_half_fold(Profile profile, int folds, double low) {
    constexpr int steps = 16;
    const double length = 1.0 / folds, step = length / steps;
    std::vector<double> found{low + length / 2};
    for (int i = 0; i <= steps; ++i) {
        const double from = std::max(low + (i - 0.5) * step, 0.0), to = std::min(low + (i + 0.5) * step, 1.0);
        if (from > 0 && (shape_slope(profile, folds, from) > 0) != (shape_slope(profile, folds, to) > 0))
            found.push_back(extremum(profile, folds, from, to));
    }
    return found;
}

/// A stretch of u, of which there are `times` in the wave.
struct Stretch {
    double low, high;
    double times;
    std::vector<double> extrema;
};

/// The half folds of `even` between the one that fades and mid-height are alike but for their direction.
std::vector<Stretch> stretches(Profile profile, int folds) {
    if (profile.kind != Profile::Kind::even) return {{0, 1, 1, extrema_before_half_waves(profile, folds)}};
    const double half_fold = 1.0 / folds, fade = 1 - half_fold;
    std::vector<Stretch> found{{fade, 1, 1, extrema_of_half_fold(profile, folds, fade)}};
    if (folds > 1) found.push_back({0, half_fold, folds - 1.0, extrema_of_half_fold(profile, folds, 0)});
    return found;
}

/// Places in a stretch between which g' is smooth and does not change its sign.
std::vector<double> pieces(Stretch stretch) {
    std::vector<double>& ends = stretch.extrema;
    std::erase_if(ends, [&](double u) { return u <= stretch.low || u >= stretch.high; });
    ends.push_back(stretch.low);
    ends.push_back(stretch.high);
    std::ranges::sort(ends);
    const auto too_near = [](double a, double b) { return b - a < 1e-9; };
    ends.erase(std::unique(ends.begin(), ends.end(), too_near), ends.end());
    ends.back() = stretch.high;
    return ends;
}

// sqrt(1 + a^2 g'^2) has a branch point about S away from every extremum: the steeper the curve, the closer.
Rule rule_for(double squeeze, Accuracy accuracy) {
    const bool full = accuracy == Accuracy::full;
    if (squeeze <= 0.1) return gauss_legendre(full ? 16 : 12);
    if (squeeze <= 0.3) return gauss_legendre(full ? 24 : 16);
    if (squeeze <= 0.6) return gauss_legendre(full ? 32 : 24);
    if (squeeze <= 0.9) return clustered(full ? 48 : 28);
    return clustered(full ? 96 : 36);
}

// Excess length of the curve, the integral of sqrt(1 + a^2 g'^2) - 1, and its derivative by a.
struct Excess {
    double length = 0;
    double slope = 0;
};

Excess excess(std::span<const Wave::Node> nodes, double a) {
    Excess sum;
    for (const Wave::Node& node : nodes) {
        const double steepness = a * node.slope;
        const double root = std::sqrt(1 + steepness * steepness);
        sum.length += node.weight * steepness * steepness / (1 + root);
        sum.slope += node.weight * steepness * node.slope / root;
    }
    return sum;
}

}  // namespace

Wave::Wave(Profile profile, int folds, double largest_squeeze, Accuracy accuracy) {
    require_folds(folds);
    require_roundness(profile.roundness);
    require_squeeze(largest_squeeze);
    const Rule rule = rule_for(largest_squeeze, accuracy);
    for (const Stretch& stretch : stretches(profile, folds)) {
        const std::vector<double> ends = pieces(stretch);
        for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
            const double width = ends[piece + 1] - ends[piece];
            for (std::size_t i = 0; i < rule.at.size(); ++i) {
                const double u = ends[piece] + width * rule.at[i];
                nodes_.push_back({stretch.times * width * rule.weight[i], paper::shape(profile, folds, u),
                                  shape_slope(profile, folds, u)});
            }
        }
    }
    for (const Node& node : nodes_) {
        shape_power_ += node.weight * node.shape * node.shape;
        slope_power_ += node.weight * node.slope * node.slope;
    }
}

double Wave::relative_amplitude(double squeeze) const {
    require_squeeze(squeeze);
    // Excess length is a^2 G / 2 for a small a, with G the integral of g'^2; the next term is q smaller.
    if (squeeze < 1e-14) return std::sqrt(2 * squeeze / slope_power_);
    const double scale = 1 - squeeze;
    const double target = squeeze / scale;
    // The length is convex in a and (by Jensen) at most sqrt(1 + a^2 G). The start is therefore below the
    // root, the first step of Newton lands above it, and from there the steps can only descend to it.
    double a = std::sqrt(squeeze * (2 - squeeze) / slope_power_) / scale;
    for (int step = 0; step < 50; ++step) {
        const Excess now = excess(nodes_, a);
        const double change = (now.length - target) / now.slope;
        a -= change;
        if (std::abs(change) <= 1e-7 * a) break;  // quadratic: the next step would be near 1e-14
    }
    return a;
}

Column Wave::column(double squeeze) const {
    const double a = relative_amplitude(squeeze);
    const double scale = 1 - squeeze;
    if (squeeze < 1e-14) return {scale * a, std::sqrt(2 / slope_power_)};
    // Eq 7 by the chain rule: length'(a) da/dq = 1 / S^2.
    const double by_squeeze = 1 / (scale * excess(nodes_, a).slope) - a;
    return {scale * a, 2 * std::sqrt(squeeze) * by_squeeze};
}

}  // namespace goffer::paper
