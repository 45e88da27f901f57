// SPDX-License-Identifier: MIT
#include "profile.hpp"
#include "rest.hpp"

#include <goffer/paper/shape.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace goffer::fit {
namespace {

constexpr double longest = 2.5;  // radii of a fold that is too long for wrinkles
constexpr double full = 1.5;     // radii of a fold up to which they have their depth

/// Full up to `full` radii, 0 from `longest` on; both a radius beyond what was asked for if that is longer.
double fade_of(double radii, double asked) {
    const double excess = radii - std::max(asked - full, 0.0);
    return glm::smoothstep(longest, full, excess);
}

/// The weights of wrinkles in `range`, which fade within a fold: a spline reaches two knots beyond each of
/// its values.
std::vector<double> weights_inside(const WrinkleRange& range, const Cylinder& cylinder, double start,
                                   double length, const std::vector<double>& folds) {
    const double step = length / static_cast<double>(folds.size() - 1);
    std::vector<double> weights;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        const double z = start + step * static_cast<double>(i);
        double inside = cylinder.length;
        if (range.first > 0) inside = z - range.first * cylinder.length;
        if (range.last < 1) inside = std::min(inside, range.last * cylinder.length - z);
        weights.push_back(glm::smoothstep(0.0, 1.0, (inside - 2 * step) / folds[i]));
    }
    return weights;
}

/// Each value and the larger ones of its neighbors: a fold reaches over several knots.
std::vector<double> widened(const std::vector<double>& values) {
    std::vector<double> wide = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) wide[i] = std::max(wide[i], values[i - 1]);
        if (i + 1 < values.size()) wide[i] = std::max(wide[i], values[i + 1]);
    }
    return wide;
}

/// How long a fold is at least, knot by knot, for the mesh's rows to carry it.
std::vector<double> row_limits(const Rows& rows, double start, double length, std::size_t knots) {
    std::vector<double> limits;
    for (std::size_t i = 0; i < knots; ++i) {
        const double z = start + length * static_cast<double>(i) / static_cast<double>(knots - 1);
        limits.push_back(rows_of_fold * rows.reach_at(z));
    }
    return widened(limits);
}

/// Sets the folds' lengths, as wanted or as rows limit them, and weights, which fade the longer folds are.
void lengthen_folds(const std::vector<double>& radii, const std::vector<double>& wanted,
                    const std::vector<double>& limits, double in_radii, paper::Shape::Knots& shape) {
    for (std::size_t i = 0; i < radii.size(); ++i) {
        shape.fold_length.push_back(
            std::clamp(limits[i], wanted[i], std::max(longest, in_radii + longest - full) * radii[i]));
        shape.weight.push_back(fade_of(std::max(limits[i], wanted[i]) / radii[i], in_radii));
    }
}

/// Whether folds are the same all along.
bool alike(const paper::Shape::Knots& shape) {
    const auto like_first = [&](double length) {
        return std::fabs(length / shape.fold_length[0] - 1) < 1e-3;
    };
    return std::ranges::all_of(shape.fold_length, like_first) &&
           std::ranges::count(shape.weight, shape.weight[0]) == std::ssize(shape.weight);
}

/// Whether what is left of wrinkles is less than one would see.
bool nothing_left(const paper::Shape::Knots& shape) {
    constexpr double unseen = 0.1;
    return std::ranges::all_of(shape.weight, [](double weight) { return weight < unseen; });
}

/// Returns how many folds of such lengths fit, at most max_folds(); 0 where all have faded. Where more would
/// fit, folds are longer, and their weights in `shape` fade by that.
int count_and_fade(double length, double radius, const std::vector<double>& radii, double in_radii,
                   paper::Shape::Knots& shape) {
    const double folds = std::round(paper::Shape(length, radius, shape).folds());
    const int most = max_folds(Profile::even);
    const double longer = std::max(folds / most, 1.0);
    for (std::size_t i = 0; longer > 1 && i < radii.size(); ++i)
        shape.weight[i] =
            std::min(shape.weight[i], fade_of(longer * shape.fold_length[i] / radii[i], in_radii));
    return nothing_left(shape) ? 0 : static_cast<int>(std::clamp<double>(folds, 1, most));
}

}  // namespace

double fold_length_at(const Cylinder& cylinder, Profile profile, std::optional<double> in_radii,
                      double radius) {
    constexpr double least_folds = 12;    // fewer are too deep on a stout body
    constexpr double shortest = 1.0 / 8;  // radii: on a ring nobody sees them
    if (in_radii) return *in_radii * radius;
    const double length = default_fold_length(profile) * radius;
    if (profile.kind != Profile::Kind::even) return length;
    return std::min(length, std::max(cylinder.length / least_folds, shortest * radius));
}

FoldPlan plan_folds(const Cylinder& cylinder, const Rows& rows, const BindOptions& options, double start,
                    double length, std::optional<int> asked) {
    const std::size_t least = options.wrinkle_range.whole() ? fewest_knots : slice_knots;
    const std::size_t knots = knots_along(length, cylinder.radius, least);
    const std::vector<double> radii = radii_at(cylinder, start, length, knots);
    const std::optional<double> said = asked ? std::nullopt : options.fold_length;
    std::vector<double> wanted(knots);  // lengths of folds
    std::ranges::transform(radii, wanted.begin(), [&](double radius) {
        return fold_length_at(cylinder, options.profile, said, radius);
    });
    paper::Shape::Knots shape;
    shape.radius = radii_of(cylinder, start, length);  // as Straightening has them
    FoldPlan plan{asked.value_or(0)};
    if (options.profile.kind == Profile::Kind::even && !asked) {
        const double in_radii = options.fold_length.value_or(default_fold_length(options.profile));
        lengthen_folds(radii, wanted, row_limits(rows, start, length, knots), in_radii, shape);
        const bool same = cylinder.radii.empty() && alike(shape);
        plan.folds = count_and_fade(length, cylinder.radius, radii, in_radii, shape);
        if (same && shape.weight[0] == 1) shape.fold_length.clear(), shape.weight.clear();
    }
    if (!options.wrinkle_range.whole() && plan.folds > 0) {
        const std::vector<double> inside =
            weights_inside(options.wrinkle_range, cylinder, start, length, wanted);
        shape.weight.resize(knots, 1);
        std::ranges::transform(shape.weight, inside, shape.weight.begin(), std::multiplies());
        if (nothing_left(shape)) plan.folds = 0;
    }
    if (shape.radius.empty() && shape.fold_length.empty() && shape.weight.empty()) return plan;
    plan.shape = std::make_shared<const paper::Shape>(length, cylinder.radius, shape);
    return plan;
}

}  // namespace goffer::fit
