// SPDX-License-Identifier: MIT
#include "chebyshev.hpp"
#include "girths.hpp"
#include "profile.hpp"
#include "text.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/paper/wave.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace goffer::fit {
namespace {

/// Squeezes at which eq 7 is solved, for Q(q).
constexpr int squeeze_points = 24;
/// Of even folds and of bodies with a shape: beyond it, a row's polynomial is off by more than 2e-6.
constexpr double max_even_squeeze = 0.9;
/// Angles at which m is solved; it is smooth in their root and close to one.
constexpr int factor_points = 16;
/// Share of the largest angle that is allowed, so that a pose at the limit still has room for rounding.
constexpr double inside = 0.999;

using paper::FoldRange;

bool wrinkles(paper::Amplitude amplitude, FoldRange folds) {
    return amplitude != paper::Amplitude::none && folds.count > 0;
}

void check_shape(paper::Profile profile, FoldRange folds, double length, double radius) {
    if (!(length > 0) || !std::isfinite(length))
        throw Error("length: " + text(length) + " is not a positive number");
    if (!(radius > 0) || !std::isfinite(radius))
        throw Error("radius: " + text(radius) + " is not a positive number");
    const int most = max_folds(profile);
    if (folds.count < 0 || folds.count > most)
        throw Error("folds: " + std::to_string(folds.count) + " is outside 0.." + std::to_string(most));
    check(profile);
}

/// Q(q) = (1 - q) a(q) / sqrt(q): the smooth part of eq 7's solution, A = (L / 2) sqrt(q) Q(q).
Chebyshev smooth_amplitude(paper::Profile profile, FoldRange folds, double largest_squeeze) {
    const paper::Wave wave(profile, folds.total, largest_squeeze);
    return {largest_squeeze, squeeze_points,
            [&](double q) { return wave.column(q).amplitude / std::sqrt(q); }};
}

/// m(alpha) as a function of the root of alpha / max_angle; 1 throughout in modes other than `area`.
Chebyshev area_factors(paper::Profile profile, paper::Amplitude amplitude, FoldRange folds, double length,
                       double radius, double max_angle) {
    const bool solved = amplitude == paper::Amplitude::area;
    return {1, solved ? factor_points : 1, [&](double root) {
                return solved
                           ? paper::area_factor(profile, folds.total, length, radius, root * root * max_angle)
                           : 1.0;
            }};
}

}  // namespace

bend::WrinkleTable make_wrinkle_table(paper::Profile profile, paper::Amplitude amplitude, FoldRange folds,
                                      double length, double radius, double max_angle, int rows,
                                      double max_scale) {
    check_shape(profile, folds, length, radius);
    if (!(max_scale >= 1) || !std::isfinite(max_scale))
        throw Error("max_scale: " + text(max_scale) + " is below 1");
    if (!(max_angle > 0) || max_angle * 2 * radius * max_scale >= length) {
        throw Error("max_angle: " + text(max_angle) + " is outside 0..length / (2 radius max_scale)");
    }
    if (rows < 2 || rows > bend::WrinkleTable::max_rows) {
        throw Error("table_rows: " + std::to_string(rows) + " is outside 2.." +
                    std::to_string(bend::WrinkleTable::max_rows));
    }
    bend::WrinkleTable table;
    if (!wrinkles(amplitude, folds)) return table;

    const double largest_t = 2 * max_scale;  // of s T
    const Chebyshev q_part = smooth_amplitude(profile, folds, largest_t * max_angle * radius / length);
    const Chebyshev factor = area_factors(profile, amplitude, folds, length, radius, max_angle);
    table.max_angle = static_cast<float>(max_angle);
    table.rows.resize(static_cast<std::size_t>(rows));
    for (int i = 0; i < rows; ++i) {
        const double root = static_cast<double>(i) / (rows - 1);
        const double largest_squeeze = largest_t * root * root * max_angle * radius / length;
        const double scale = folds.wave_length(length) / 2 * factor(root);
        const Chebyshev profile_in_t(1, static_cast<int>(bend::wrinkle_degree) + 1,
                                     [&](double t) { return scale * q_part(largest_squeeze * t); });
        const std::vector<double> coefficients = profile_in_t.monomials();
        bend::WrinkleRow& row = table.rows[static_cast<std::size_t>(i)];
        double per_power = 1;  // from powers of t = s T / largest_t to powers of s T
        for (std::size_t n = 0; n < row.size(); ++n, per_power /= largest_t)
            row[n] = static_cast<float>(coefficients[n] * per_power);
    }
    return table;
}

double largest_angle(paper::Profile profile, paper::Amplitude amplitude, FoldRange folds, double length,
                     double radius, double rho_max, double factor) {
    check_shape(profile, folds, length, radius);
    if (!(rho_max >= 0) || !std::isfinite(rho_max)) {
        throw Error("rho_max: " + text(rho_max) + " is not a distance; give 0 or more");
    }
    const double outermost = std::max(rho_max, radius);
    const double most = profile.kind == Profile::Kind::even ? max_even_squeeze : 1 - 1e-9;
    const double half_wave = folds.wave_length(length) / 2;
    std::optional<paper::Wave> wave;
    if (wrinkles(amplitude, folds)) wave.emplace(profile, folds.total, most);
    const auto search = [&](double own) {
        double low = 0;
        double high = most * length / (2 * radius);
        for (int step = 0; step < 60; ++step) {
            const double alpha = (low + high) / 2;
            const double squeeze = 2 * alpha * radius / length;
            const double outward =
                wave ? own * profile.crest() * wave->column(squeeze).amplitude * half_wave : 0;
            (length / alpha - radius > outermost + outward ? low : high) = alpha;
        }
        return low;
    };
    const double angle = inside * search(factor);
    if (amplitude != paper::Amplitude::area || !wrinkles(amplitude, folds)) return angle;
    // m grows with the angle, so that its value at a larger angle is safe at a smaller one.
    const auto with_area_factor = [&](double alpha) {
        return inside * search(factor * paper::area_factor(profile, folds.total, length, radius, alpha));
    };
    const double corrected = with_area_factor(angle);
    return corrected <= angle ? corrected : with_area_factor(corrected);
}

double largest_angle(const Girths& girths, paper::Profile profile, paper::Amplitude amplitude,
                     FoldRange folds, double factor) {
    double thickest = 0;
    for (const Girth& girth : girths.slices) thickest = std::max(thickest, girth.scale);
    const bool wrinkled = wrinkles(amplitude, folds);
    const double per_length = 1 / girths.length, half_wave = folds.wave_length(girths.length) / 2;
    const Chebyshev q_part = wrinkled ? smooth_amplitude(profile, folds, max_even_squeeze)
                                      : Chebyshev(1, 1, [](double) { return 0.0; });
    double low = 0, high = max_even_squeeze * girths.length / (2 * girths.radius * thickest);
    const auto fits = [&](double alpha, const Girth& girth) {
        const double q = std::min(2 * alpha * girths.radius * girth.scale * per_length, max_even_squeeze);
        const double outward = wrinkled ? factor * girth.depth * half_wave * std::sqrt(q) * q_part(q) : 0;
        return girths.length / alpha - girths.radius > girth.rho + outward;
    };
    for (int step = 0; step < 60; ++step) {
        const double alpha = (low + high) / 2;
        const bool all = std::ranges::all_of(girths.slices, [&](const Girth& g) { return fits(alpha, g); });
        (all ? low : high) = alpha;
    }
    return inside * low;
}

}  // namespace goffer::fit
