// SPDX-License-Identifier: MIT
#include "goffer/paper/wrinkle.hpp"

#include <goffer/paper/wave.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::paper {

namespace {

using std::numbers::pi;

/// A function of u and its slope.
struct Value {
    double value;
    double slope;
};

/// What the wave is multiplied by: 1 at mid-height, 0 at the ends.
Value fade(Profile profile, int folds, double u) {
    if (profile.kind == Profile::Kind::damped) return {1 - u, -1};
    if (profile.kind == Profile::Kind::smooth) {
        const double inside = 1 - u * u;
        return {inside * inside, -4 * u * inside};
    }
    // A smoothstep over the first half of the first fold and the last half of the last.
    const double per_half_fold = folds;
    const double t = std::min((1 - u) * per_half_fold, 1.0);
    return {t * t * (3 - 2 * t), -6 * t * (1 - t) * per_half_fold};
}

Value wave(Profile profile, int folds, double u) {
    if (profile.kind != Profile::Kind::even) {
        const double frequency = 2 * pi * folds;
        return {std::cos(frequency * u), -frequency * std::sin(frequency * u)};
    }
    const double phase = pi * folds * u, b = profile.roundness;
    return {std::cos(phase) - b * std::cos(2 * phase),
            -pi * folds * (std::sin(phase) - 2 * b * std::sin(2 * phase))};
}

}  // namespace

double shape(Profile profile, int folds, double u) {
    return fade(profile, folds, u).value * wave(profile, folds, u).value;
}

double shape_slope(Profile profile, int folds, double u) {
    const Value faded = fade(profile, folds, u), waving = wave(profile, folds, u);
    return faded.value * waving.slope + faded.slope * waving.value;
}

double squeeze(double kappa, double beta, double theta) {
    const double half = std::cos((beta - theta) / 2);
    return 2 * kappa * half * half;
}

double relative_amplitude(Profile profile, int folds, double squeeze) {
    return Wave(profile, folds, squeeze).relative_amplitude(squeeze);
}

double amplitude(Profile profile, int folds, double length, double squeeze) {
    return length / 2 * (1 - squeeze) * relative_amplitude(profile, folds, squeeze);
}

}  // namespace goffer::paper
