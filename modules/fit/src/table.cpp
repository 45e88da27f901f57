// SPDX-License-Identifier: MIT
#include "chebyshev.hpp"
#include "text.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/paper/wave.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::fit {
namespace {

constexpr int squeeze_points = 24;  // squeezes at which eq 7 is solved, for Q(q)
constexpr int factor_points = 16;  // angles at which m is solved; it is smooth in their root and close to one

bool wrinkles(paper::Amplitude amplitude, int folds) {
    return amplitude != paper::Amplitude::none && folds > 0;
}

void check_shape(int folds, double length, double radius) {
    if (!(length > 0) || !std::isfinite(length))
        throw Error("length: " + text(length) + " is not a positive number");
    if (!(radius > 0) || !std::isfinite(radius))
        throw Error("radius: " + text(radius) + " is not a positive number");
    if (folds < 0 || folds > BindOptions::max_folds) {
        throw Error("folds: " + std::to_string(folds) + " is outside 0.." +
                    std::to_string(BindOptions::max_folds));
    }
}

/// Q(q) = (1 - q) a(q) / sqrt(q): the smooth part of eq 7's solution, A = (L / 2) sqrt(q) Q(q).
Chebyshev smooth_amplitude(paper::Profile profile, int folds, double largest_squeeze) {
    const paper::Wave wave(profile, folds, largest_squeeze);
    return {0, largest_squeeze, squeeze_points,
            [&](double q) { return wave.column(q).amplitude / std::sqrt(q); }};
}

/// m(alpha) as a function of the root of alpha / max_angle; 1 throughout in modes other than `area`.
Chebyshev area_factors(paper::Profile profile, paper::Amplitude amplitude, int folds, double length,
                       double radius, double max_angle) {
    const bool solved = amplitude == paper::Amplitude::area;
    return {0, 1, solved ? factor_points : 1, [&](double root) {
                return solved ? paper::area_factor(profile, folds, length, radius, root * root * max_angle)
                              : 1.0;
            }};
}

}  // namespace

bend::WrinkleTable make_wrinkle_table(paper::Profile profile, paper::Amplitude amplitude, int folds,
                                      double length, double radius, double max_angle, int rows) {
    check_shape(folds, length, radius);
    if (!(max_angle > 0) || max_angle * 2 * radius >= length) {
        throw Error("max_angle: " + text(max_angle) + " is outside 0..length / (2 radius)");
    }
    if (rows < 2 || rows > 4096) throw Error("table_rows: " + std::to_string(rows) + " is outside 2..4096");
    bend::WrinkleTable table;
    if (!wrinkles(amplitude, folds)) return table;

    const Chebyshev q_part = smooth_amplitude(profile, folds, 2 * max_angle * radius / length);
    const Chebyshev factor = area_factors(profile, amplitude, folds, length, radius, max_angle);
    table.max_angle = static_cast<float>(max_angle);
    table.rows.resize(static_cast<std::size_t>(rows));
    for (int i = 0; i < rows; ++i) {
        const double root = static_cast<double>(i) / (rows - 1);
        const double two_kappa = 2 * root * root * max_angle * radius / length;
        const double scale = length / 2 * factor(root);
        const Chebyshev profile_in_t(0, 1, static_cast<int>(bend::wrinkle_degree) + 1,
                                     [&](double t) { return scale * q_part(two_kappa * t); });
        const std::vector<double> coefficients = profile_in_t.monomials();
        bend::WrinkleRow& row = table.rows[static_cast<std::size_t>(i)];
        for (std::size_t n = 0; n < row.size(); ++n) {  // from powers of t = T / 2 to powers of T
            row[n] = static_cast<float>(std::ldexp(coefficients[n], -static_cast<int>(n)));
        }
    }
    return table;
}

double largest_angle(paper::Profile profile, paper::Amplitude amplitude, int folds, double length,
                     double radius, double rho_max, double factor) {
    check_shape(folds, length, radius);
    if (!(rho_max >= 0) || !std::isfinite(rho_max)) {
        throw Error("rho_max: " + text(rho_max) + " is not a distance; give 0 or more");
    }
    const double outermost = std::max(rho_max, radius);
    const auto search = [&](double own) {
        double low = 0;
        double high = length / (2 * radius);
        for (int step = 0; step < 60; ++step) {
            const double alpha = (low + high) / 2;
            const double squeeze = std::min(2 * alpha * radius / length, 1 - 1e-9);
            const double lift =
                wrinkles(amplitude, folds) ? own * paper::amplitude(profile, folds, length, squeeze) : 0;
            (length / alpha - radius > outermost + lift ? low : high) = alpha;
        }
        return low;
    };
    constexpr double inside = 0.999;  // so that a pose at the limit still has room for rounding
    const double angle = inside * search(factor);
    if (amplitude != paper::Amplitude::area || !wrinkles(amplitude, folds)) return angle;
    // m grows with the angle, so the factor at the plain limit is no smaller than the one at the limit that
    // it gives.
    return inside * search(factor * paper::area_factor(profile, folds, length, radius, angle));
}

}  // namespace goffer::fit
