// SPDX-License-Identifier: MIT
#include "goffer/paper/wrinkle.hpp"

#include <goffer/paper/wave.hpp>

#include <cmath>
#include <numbers>

namespace goffer::paper {

double shape(Profile profile, int folds, double u) {
    const double wave = std::cos(2 * std::numbers::pi * folds * u);
    const double fade = profile == Profile::damped ? 1 - u : (1 - u * u) * (1 - u * u);
    return fade * wave;
}

double shape_slope(Profile profile, int folds, double u) {
    const double frequency = 2 * std::numbers::pi * folds;
    const double wave = std::cos(frequency * u);
    const double wave_slope = -frequency * std::sin(frequency * u);
    if (profile == Profile::damped) return (1 - u) * wave_slope - wave;
    const double inside = 1 - u * u;
    return inside * inside * wave_slope - 4 * u * inside * wave;
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
