// SPDX-License-Identifier: MIT
#include <goffer/paper/wave.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace goffer::paper;

namespace {

// Eq 6 and its derivative, written down a second time.
double slope(Profile profile, int folds, double u) {
    const double w = 2 * std::numbers::pi * folds;
    if (profile.kind == Profile::Kind::even) {
        const double t = std::min((1 - u) * folds, 1.0), p = w / 2 * u, b = profile.roundness;
        const double fade = 3 * t * t - 2 * t * t * t, fade_slope = t < 1 ? -6 * folds * (t - t * t) : 0;
        return fade_slope * (std::cos(p) - b * std::cos(2 * p)) -
               fade * w / 2 * (std::sin(p) - 2 * b * std::sin(2 * p));
    }
    if (profile == Profile::damped) return -std::cos(w * u) - w * (1 - u) * std::sin(w * u);
    return -4 * u * (1 - u * u) * std::cos(w * u) - w * std::pow(1 - u * u, 2) * std::sin(w * u);
}

template <class F>
double simpson(int steps, F&& f) {
    double sum = f(0.0) + f(1.0);
    for (int i = 1; i < steps; ++i) sum += (i % 2 ? 4 : 2) * f(static_cast<double>(i) / steps);
    return sum / (3.0 * steps);
}

}  // namespace

TEST_CASE("eq 7 is solved: the wrinkled strip is as long as the column was") {
    const Profile plain_cosine{Profile::Kind::even, 0}, roundest{Profile::Kind::even, 0.5};
    for (const Profile profile : {Profile::damped, Profile::smooth, Profile::even, plain_cosine, roundest}) {
        for (const int folds : {1, 2, 5, 12}) {
            for (const double q : {1e-12, 1e-6, 0.05, 0.1, 0.25, 0.5, 0.65, 0.9}) {
                const double a = relative_amplitude(profile, folds, q);
                const double excess = simpson(12000 * folds, [&](double u) {
                    const double rise = a * slope(profile, folds, u);
                    return rise * rise / (1 + std::sqrt(1 + rise * rise));
                });
                CAPTURE(folds);
                CAPTURE(q);
                CHECK(excess == doctest::Approx(q / (1 - q)).epsilon(2e-11));
            }
        }
    }
}

TEST_CASE("eq 7 is solved for the steepest columns") {
    for (const Profile profile : {Profile::damped, Profile::smooth, Profile::even}) {
        for (const double q : {0.99, 0.999}) {
            const double a = relative_amplitude(profile, 3, q);
            const double length =
                simpson(2'000'000, [&](double u) { return std::hypot(1.0, a * slope(profile, 3, u)); });
            CHECK(length * (1 - q) == doctest::Approx(1).epsilon(1e-11));
        }
    }
}

TEST_CASE("the amplitude starts like the square root of the squeeze") {
    for (const Profile profile : {Profile::damped, Profile::smooth}) {
        const double power = simpson(20000, [&](double u) { return std::pow(slope(profile, 4, u), 2); });
        CHECK(relative_amplitude(profile, 4, 0) == 0);
        for (const double q : {1e-300, 1e-18, 0.99e-14, 1.01e-14, 1e-12}) {
            CHECK(relative_amplitude(profile, 4, q) ==
                  doctest::Approx(std::sqrt(2 * q / power)).epsilon(1e-11).scale(0));
        }
        CHECK(amplitude(profile, 4, 7.0, 0.2) ==
              doctest::Approx(3.5 * 0.8 * relative_amplitude(profile, 4, 0.2)).epsilon(1e-14));
    }
}

TEST_CASE("shapes: values at the ends, slope, mean displacement") {
    for (const Profile profile : {Profile::damped, Profile::smooth}) {
        CHECK(shape(profile, 3, 0) == doctest::Approx(1));
        CHECK(shape(profile, 3, 1) == doctest::Approx(0));
        for (const double u : {0.1, 0.37, 0.5, 0.83}) {
            const double h = 1e-5;
            CHECK(shape_slope(profile, 3, u) ==
                  doctest::Approx((shape(profile, 3, u + h) - shape(profile, 3, u - h)) / (2 * h))
                      .epsilon(1e-7));
        }
    }
    const auto mean = [](Profile profile, int folds) {
        return simpson(20000, [&](double u) { return shape(profile, folds, u); });
    };
    const double w = 2 * std::numbers::pi * 3;
    CHECK(std::abs(mean(Profile::damped, 3)) < 1e-13);
    // Small, but not zero.
    CHECK(mean(Profile::smooth, 3) == doctest::Approx(-24 / (w * w * w * w)).epsilon(1e-6));
    CHECK(shape_slope(Profile::smooth, 3, 0) == doctest::Approx(0));
    CHECK(std::abs(shape_slope(Profile::smooth, 3, 1)) < 1e-14);
}

TEST_CASE("even folds: fading ends, crests and troughs of the depth that the profile says") {
    for (const double roundness : {0.0, 0.1, 0.25, 0.4, 0.5}) {
        const Profile profile{Profile::Kind::even, roundness};
        for (const int folds : {1, 2, 9, 12}) {
            CHECK(shape(profile, folds, 1) == 0);
            CHECK(shape_slope(profile, folds, 1) == doctest::Approx(0));
            CHECK(shape_slope(profile, folds, 0) == doctest::Approx(0));
            double crest = 0, trough = 0;
            for (double u = 0; u <= 1; u += 1e-4) {
                crest = std::max(crest, shape(profile, folds, u));
                trough = std::max(trough, -shape(profile, folds, u));
            }
            CHECK(crest <= profile.crest() + 1e-12);
            CHECK(trough <= profile.trough() + 1e-12);
            if (folds < 9) continue;
            CHECK(crest == doctest::Approx(profile.crest()).epsilon(1e-4));
            CHECK(trough == doctest::Approx(profile.trough()).epsilon(1e-4));
        }
    }
    CHECK(Profile::even.folds_of_length(7) == 7);
    CHECK(Profile::damped.folds_of_length(7) == 14);
    CHECK_THROWS_AS(Wave({Profile::Kind::even, 0.6}, 3, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(Wave({Profile::Kind::even, std::nan("")}, 3, 0.1), std::invalid_argument);
}

TEST_CASE("a column's slope is the derivative of its amplitude by the root of the squeeze") {
    for (const Profile profile : {Profile::damped, Profile::smooth, Profile::even}) {
        const Wave wave(profile, 5, 0.96);
        for (const double root : {0.01, 0.3, 0.6, 0.9, 0.97}) {
            const double h = 1e-4;
            const auto at = [&](double r) { return wave.column(r * r).amplitude; };
            const double numeric =
                (8 * (at(root + h) - at(root - h)) - (at(root + 2 * h) - at(root - 2 * h))) / (12 * h);
            CHECK(wave.column(root * root).slope == doctest::Approx(numeric).epsilon(1e-8));
        }
        CHECK(wave.column(0).slope == doctest::Approx(wave.column(1e-10).slope).epsilon(1e-8));
    }
}

TEST_CASE("the squeeze of a column") {
    CHECK(squeeze(0.2, 1.0, 1.0) == doctest::Approx(0.4));
    CHECK(squeeze(0.2, 0.3, 1.0) == doctest::Approx(0.2 * (1 + std::cos(0.7))).epsilon(1e-14));
    CHECK(squeeze(0.2, 1.0, 1.0 + std::numbers::pi) < 1e-30);
}

TEST_CASE("what has no amplitude is refused") {
    CHECK_THROWS_AS(static_cast<void>(relative_amplitude(Profile::damped, 0, 0.1)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(relative_amplitude(Profile::damped, 3, 1.0)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(relative_amplitude(Profile::damped, 3, -1e-9)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(amplitude(Profile::smooth, 3, 1, std::nan(""))), std::invalid_argument);
}
