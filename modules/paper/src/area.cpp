// SPDX-License-Identifier: MIT
#include "goffer/paper/wrinkle.hpp"
#include "quadrature.hpp"

#include <goffer/paper/wave.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace goffer::paper {
namespace {

constexpr double largest_factor = 1.5;

struct Cylinder {
    double length;
    double radius;
};

void require_bend(const Cylinder& base, double angle) {
    if (!(base.length > 0 && base.radius > 0 && std::isfinite(base.length))) {
        throw std::invalid_argument("length and radius must be positive numbers");
    }
    const double limit = base.length / (2 * base.radius);
    if (!(angle >= 0 && angle < limit)) {
        std::ostringstream text;
        text << "angle is " << angle
             << " rad: it must be 0 or more and below length / (2 radius) = " << limit;
        throw std::invalid_argument(text.str());
    }
}

// A column of the base in the bent, wrinkled state, as the area sees it.
struct AreaColumn {
    double weight;  // of the mean over beta
    double cosine;  // of beta - theta
    double squeeze;
    double amplitude;  // A / r
    double slope;      // (dA / dbeta) / r
};

// Columns on one side of the bend plane, which the other mirrors. In h = cos(beta / 2) everything is smooth.
std::vector<AreaColumn> area_columns(const Wave& wave, const Cylinder& base, double kappa, int count) {
    const Rule rule = gauss_legendre(count);
    const double half_length = base.length / (2 * base.radius);
    std::vector<AreaColumn> made;
    for (std::size_t i = 0; i < rule.at.size(); ++i) {
        const double half = std::numbers::pi / 2 * rule.at[i];
        const double q = 2 * kappa * std::cos(half) * std::cos(half);
        const Column column = wave.column(q);
        const double root_slope = -std::sqrt(2 * kappa) * std::sin(half) / 2;
        made.push_back({rule.weight[i], std::cos(2 * half), q, half_length * column.amplitude,
                        half_length * column.slope * root_slope});
    }
    return made;
}

// Lateral area over 2 pi r L, less one. The element is |dP/dbeta x dP/dz| with dP/dbeta = (A' g, rho', 0) and
// dP/dz = (A g_z, 0, T) in the bent frame, T = (1 - kappa) - alpha / L rho' c. Written as (X - 1) / (1 + sqrt
// X), so that nothing cancels at small angles.
double area_excess(const Wave& wave, const std::vector<AreaColumn>& columns, const Cylinder& base,
                   double kappa, double factor) {
    const double slope_scale = 2 * base.radius / base.length;
    double sum = 0;
    for (const AreaColumn& column : columns) {
        const double amplitude = factor * column.amplitude;
        const double slope = factor * column.slope;
        double along = 0;
        for (const Wave::Node& node : wave.nodes()) {
            const double outward = amplitude * node.shape;
            const double lost = column.squeeze + kappa * column.cosine * outward;
            const double stretch = (1 - lost) * (1 - lost);
            const double steepness = amplitude * node.slope * slope_scale;
            const double across = slope * node.shape;
            const double beyond = outward * (2 + outward) * (stretch + steepness * steepness) -
                                  lost * (2 - lost) + steepness * steepness + across * across * stretch;
            along += node.weight * beyond / (1 + std::sqrt(std::max(0.0, 1 + beyond)));
        }
        sum += column.weight * along;
    }
    return sum;
}

// Limit of m as alpha -> 0, where area and length are both quadratic in the amplitude: eq 7 makes up for the
// mean squeeze kappa along z, and the waves across beta add kappa (L / r)^2 N / (16 G), N and G the integrals
// of g^2, g'^2.
double factor_at_rest(const Wave& wave, const Cylinder& base) {
    const double slender = base.length / base.radius;
    return 1 / std::sqrt(1 + slender * slender * wave.shape_power() / (16 * wave.slope_power()));
}

}  // namespace

double lateral_area(Profile profile, int folds, double length, double radius, double angle, double factor) {
    const Cylinder base{length, radius};
    require_bend(base, angle);
    const double kappa = angle * radius / length;
    if (factor == 0) return 1 - kappa;
    const Wave wave(profile, folds, 2 * kappa);
    return 1 + area_excess(wave, area_columns(wave, base, kappa, kappa < 0.3 ? 32 : 64), base, kappa, factor);
}

double area_factor(Profile profile, int folds, double length, double radius, double angle) {
    const Cylinder base{length, radius};
    require_bend(base, angle);
    const double kappa = angle * radius / length;
    const Wave wave(profile, folds, 2 * kappa, Accuracy::table);
    const double at_rest = factor_at_rest(wave, base);
    if (kappa < 1e-14) return at_rest;
    const std::vector<AreaColumn> columns = area_columns(wave, base, kappa, kappa < 0.3 ? 16 : 28);
    const auto miss = [&](double factor) { return area_excess(wave, columns, base, kappa, factor); };

    // Without a wrinkle kappa is missing, and the area grows with the factor: secant steps within a bracket.
    if (miss(largest_factor) <= 0) return largest_factor;
    double low = 0, high = largest_factor;
    double before = 0, before_miss = -kappa, factor = at_rest;
    for (int step = 0; step < 60; ++step) {
        const double now = miss(factor);
        (now < 0 ? low : high) = factor;
        double next = factor - now * (factor - before) / (now - before_miss);
        if (!(next > low && next < high)) next = (low + high) / 2;
        before = std::exchange(factor, next);
        before_miss = now;
        if (std::abs(factor - before) < 1e-7 || now == 0) break;  // the next would be below 1e-11
    }
    return factor;
}

}  // namespace goffer::paper
