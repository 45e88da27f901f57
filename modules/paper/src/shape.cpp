// SPDX-License-Identifier: MIT
#include "goffer/paper/shape.hpp"

#include "quadrature.hpp"

#include <goffer/paper/closed_form.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace goffer::paper {
namespace {

constexpr int fold_steps = 256;  // at which the count of folds is kept

/// A place on a spline: between which control values, and how far.
struct Place {
    std::size_t first;
    double t;
};

Place place_of(double z, double length, double step, std::size_t values) {
    const double at = std::clamp(z, 0.0, length) / step;
    const std::size_t segment = std::min(static_cast<std::size_t>(at), values - 4);
    return {segment, at - static_cast<double>(segment)};
}

double blended(const std::vector<double>& values, std::size_t first, const std::array<double, 4>& weights) {
    assert(first + weights.size() <= values.size());
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[first + i];
    return sum;
}

/// Integrals of a segment's four weights from 0 to t.
std::array<double, 4> integrals(double t) {
    const double t2 = t * t, t3 = t2 * t, t4 = t2 * t2, back = (1 - t) * (1 - t);
    return {(1 - back * back) / 24, (0.75 * t4 - 2 * t3 + 4 * t) / 6, (-0.75 * t4 + t3 + 1.5 * t2 + t) / 6,
            t4 / 24};
}

std::vector<double> with_ends(std::vector<double> values) {
    const std::size_t count = values.size();
    const double before = 2 * values[0] - values[1], behind = 2 * values[count - 1] - values[count - 2];
    values.insert(values.begin(), before);
    values.push_back(behind);
    return values;
}

std::vector<double> checked(double length, std::vector<double> values) {
    if (!(length > 0 && std::isfinite(length)))
        throw std::invalid_argument("length is " + std::to_string(length) + ": it must be a positive number");
    if (values.size() < 2) throw std::invalid_argument("a profile along the body needs 2 values or more");
    for (const double value : values) {
        if (!std::isfinite(value))
            throw std::invalid_argument("a value of a profile along the body is not finite");
    }
    return values;
}

/// `values`, or two times `otherwise` where there are none.
std::vector<double> values_or(const std::vector<double>& values, double otherwise) {
    return values.empty() ? std::vector<double>{otherwise, otherwise} : values;
}

std::vector<double> checked_range(std::vector<double> values, double low, double high, const char* name) {
    for (const double value : values) {
        if (!(value >= low && value <= high)) {
            throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                        " somewhere; give values within " + std::to_string(low) + ".." +
                                        std::to_string(high));
        }
    }
    return values;
}

constexpr double tiny = 1e-300, huge = 1e300;

}  // namespace

Spline::Spline(double length, std::vector<double> values)
    : length_(length),
      step_(length / static_cast<double>(values.size() > 1 ? values.size() - 1 : 1)),
      values_(with_ends(checked(length, std::move(values)))) {
    const std::array<double, 4> whole = integrals(1);
    sums_.push_back(0);
    for (std::size_t i = 0; i + 3 < values_.size(); ++i)
        sums_.push_back(sums_.back() + step_ * blended(values_, i, whole));
}

double Spline::operator()(double z) const {
    const auto [first, t] = place_of(z, length_, step_, values_.size());
    const double t2 = t * t, t3 = t2 * t, back = 1 - t;
    return blended(
        values_, first,
        {back * back * back / 6, (3 * t3 - 6 * t2 + 4) / 6, (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6});
}

double Spline::slope(double z) const {
    const auto [first, t] = place_of(z, length_, step_, values_.size());
    const double t2 = t * t, back = 1 - t;
    return blended(values_, first,
                   {-back * back / 2, (3 * t2 - 4 * t) / 2, (-3 * t2 + 2 * t + 1) / 2, t2 / 2}) /
           step_;
}

double Spline::integral(double z) const {
    const auto [first, t] = place_of(z, length_, step_, values_.size());
    return sums_[first] + step_ * blended(values_, first, integrals(t));
}

double Spline::largest() const {
    double largest = 0;
    for (std::size_t i = 0; i + 3 < values_.size(); ++i) {
        const double z = step_ * static_cast<double>(i);
        const auto take = [&](double t) {
            if (t >= 0 && t <= 1) largest = std::max(largest, (*this)(z + t * step_));
        };
        take(0);
        take(1);
        // Where the slope, a t^2 + 2 b t + c, is 0.
        const double a = (values_[i + 3] - values_[i]) / 2 - 1.5 * (values_[i + 2] - values_[i + 1]);
        const double b = (values_[i] - 2 * values_[i + 1] + values_[i + 2]) / 2;
        const double c = (values_[i + 2] - values_[i]) / 2, square = b * b - a * c;
        if (square < 0) continue;
        const double q = -(b + std::copysign(std::sqrt(square), b));
        if (a != 0) take(q / a);
        if (q != 0) take(c / q);
    }
    return largest;
}

Shape::Shape(double length, double radius, const Knots& knots)
    : knots_(knots),
      radius_(length, checked_range(values_or(knots.radius, radius), tiny, huge, "radius")),
      fold_length_(length, checked_range(knots.fold_length.empty() ? values_or(knots.radius, radius)
                                                                   : knots.fold_length,
                                         tiny, huge, "fold_length")),
      weight_(length, checked_range(values_or(knots.weight, 1), 0, 4, "weight")),
      round_(knots.radius.empty()),
      mean_(round_ ? radius : radius_.mean()),
      max_scale_(round_ ? 1 : radius_.largest() / mean_) {
    const double step = length / fold_steps;
    folds_.push_back(0);
    for (int i = 0; i < fold_steps; ++i)
        folds_.push_back(folds_.back() + folds_between(step * i, step * (i + 1)));
}

double Shape::drift(double z) const {
    const double length = radius_.length();
    if (round_ || z <= 0 || z >= length) return 0;
    return radius_.integral(z) - mean_ * z;
}

double Shape::unshifted(double arc_z, double curvature) const {
    const double length = radius_.length();
    if (arc_z <= 0 || arc_z >= length || curvature == 0) return arc_z;
    double low = 0, high = length, z = arc_z;
    for (int step = 0; step < 100; ++step) {  // Newton's, within a bracket
        const double off = z - curvature * drift(z) - arc_z;
        (off > 0 ? high : low) = z;
        if (std::abs(off) <= 1e-15 * length) break;
        const double next = z - off / (1 - curvature * mean_ * (scale(z) - 1));
        z = next > low && next < high ? next : (low + high) / 2;
    }
    return z;
}

double Shape::folds_between(double low, double high) const {
    static const Rule rule = gauss_legendre(8);
    double sum = 0;
    for (std::size_t i = 0; i < rule.at.size(); ++i)
        sum += rule.weight[i] / fold_length_(low + (high - low) * rule.at[i]);
    return (high - low) * sum;
}

double Shape::folds_share(double z) const {
    const double length = radius_.length(), step = length / fold_steps;
    const double at = std::clamp(z, 0.0, length);
    const auto begun = std::min(static_cast<std::size_t>(at / step), folds_.size() - 2);
    const double folds = folds_[begun] + folds_between(step * static_cast<double>(begun), at);
    return folds / folds_.back();
}

double Shape::depth(double z) const {
    return fold_length_(z) * folds_.back() / fold_length_.length() * weight_(z);
}

double Shape::depth_slope(double z) const {
    const double product = fold_length_.slope(z) * weight_(z) + fold_length_(z) * weight_.slope(z);
    return folds_.back() / fold_length_.length() * product;
}

double Shape::wave(Profile profile, FoldRange folds, double z) const {
    return depth(z) * shape(profile, folds.total, std::min(std::abs(folds.place(folds_share(z))), 1.0));
}

// With t the share of folds, dt/dz = 1 / (fold_length folds_.back()), so that depth dt/dz = weight / L.
double Shape::wave_slope(Profile profile, FoldRange folds, double z) const {
    const double share = std::clamp(folds_share(z), 0.0, 1.0), length = radius_.length();
    return weight_(z) * shape_slope_z(profile, folds, length, share * length) +
           depth_slope(z) * shape(profile, folds.total, std::min(std::abs(folds.place(share)), 1.0));
}

WaveAt wave_at(const Shape* shape, Profile profile, FoldRange folds, double length, double z) {
    if (shape != nullptr) return {shape->wave(profile, folds, z), shape->wave_slope(profile, folds, z)};
    const double u = std::min(std::abs(folds.place(z / length)), 1.0);
    return {paper::shape(profile, folds.total, u), shape_slope_z(profile, folds, length, z)};
}

}  // namespace goffer::paper
