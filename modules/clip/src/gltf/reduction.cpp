// SPDX-License-Identifier: MIT
#include "reduction.hpp"

#include "components.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::clip {

namespace {

using Eigen::Index;

/// The frames themselves, one after the other.
Blend all_frames(Moves& moves) {
    const std::size_t count = moves.count();
    Blend blend{Shapes(moves.rest(), count), std::vector<float>(count * count, 0.0f), true, GltfLimit::none};
    for (std::size_t f = 0; f < count; ++f) {
        moves.read(f, true);
        moves.copy(blend.targets.positions(f), blend.targets.normals(f));
        blend.weights[f * count + f] = 1.0f;
    }
    return blend;
}

/// A first guess: vertices that are off most are off by some times the root mean square.
std::size_t first_guess(const Spread& spread, const Rest& rest, double max_error) {
    const double per_vertex =
        static_cast<double>(spread.samples.size()) * static_cast<double>(rest.entries());
    double left = spread.all;
    Index k = 0;
    while (k < spread.values.size() && std::sqrt(std::max(0.0, left) / per_vertex) > max_error / 8)
        left -= spread.values[k++];
    return static_cast<std::size_t>(k);
}

/// A blend of the first `count` components. Their weights become 0 to 1, and the mean what these begin with.
Blend blend_of(Shapes components, const Weights& weights, std::size_t count) {
    components.shorten(count + 1);
    auto matrix = components.matrix();
    const auto used = static_cast<Index>(count);
    const auto of = weights.of.leftCols(used);
    const Eigen::RowVectorXd least = of.colwise().minCoeff();
    Eigen::RowVectorXd range = of.colwise().maxCoeff() - least;
    for (Index k = 0; k < used; ++k) {
        matrix.col(0) += static_cast<float>(least[k]) * matrix.col(k + 1);
        if (!(range[k] > 0.0)) range[k] = 1.0;
        matrix.col(k + 1) *= static_cast<float>(range[k]);
    }
    const bool begins_at_rest = matrix.col(0).isZero(0.0f);
    Blend blend{std::move(components), {}, weights.of.rows() == 1, GltfLimit::none};
    if (begins_at_rest) blend.targets.drop_first();
    blend.weights.reserve(static_cast<std::size_t>(of.rows()) * blend.targets.count());
    for (Index f = 0; f < of.rows(); ++f) {
        if (!begins_at_rest) blend.weights.push_back(1.0f);
        for (Index k = 0; k < used; ++k)
            blend.weights.push_back(
                std::clamp(static_cast<float>((of(f, k) - least[k]) / range[k]), 0.0f, 1.0f));
    }
    return blend;
}

/// What rounding to floats adds comes on top.
double before_rounding(double max_error) {
    return 0.98 * max_error;
}

/// How many components the error asks for; all where that is not enough.
std::size_t enough(const std::vector<double>& max_errors, double max_error) {
    const auto good =
        std::ranges::find_if(max_errors, [&](double e) { return e <= before_rounding(max_error); });
    return std::min(static_cast<std::size_t>(good - max_errors.begin()), max_errors.size() - 1);
}

/// How many components there may be, and why there are no more.
struct Most {
    std::size_t count = 0;
    GltfLimit limit = GltfLimit::none;
};

Most most_components(std::size_t rank, const Capacity& capacity, const Reduction& how, std::size_t frames) {
    // One target is what the others begin with.
    if (how.targets && *how.targets - 1 < std::min(rank, capacity.components - 1))
        return {*how.targets - 1, GltfLimit::targets};
    if (capacity.components - 1 < rank) return {capacity.components - 1, GltfLimit::memory};
    if (capacity.samples == frames) return {rank, GltfLimit::rounding};
    return {rank, capacity.samples < most_samples ? GltfLimit::memory : GltfLimit::samples};
}

}  // namespace

Blend reduce(Moves& moves, const Reduction& how) {
    const Capacity capacity(how.memory, moves.rest().entries(), moves.count());
    const Spread spread = spread_of(moves, capacity);
    const auto rank = static_cast<std::size_t>(spread.values.size());
    const Most most = most_components(rank, capacity, how, moves.count());
    const bool room_for_all =
        moves.count() <= std::min(capacity.components, how.targets.value_or(moves.count()));
    for (std::size_t count = first_guess(spread, moves.rest(), how.max_error);; count = 2 * count + 2) {
        count = std::min(count, most.count);
        Shapes components = components_of(moves, spread, count, capacity);
        const Weights weights = weights_of(moves, components);
        const std::size_t used = enough(weights.max_errors, how.max_error);
        const bool met = weights.max_errors[used] <= before_rounding(how.max_error);
        if (!met && count < most.count) continue;
        const bool as_many = used > 0 && used + 1 >= moves.count();
        const bool lost = !met && most.limit == GltfLimit::rounding;
        if (room_for_all && (as_many || lost)) return all_frames(moves);
        Blend blend = blend_of(std::move(components), weights, used);
        if (!met) blend.limit = most.limit;
        return blend;
    }
}

void prune(Blend& blend, double tolerance) {
    if (blend.exact) return;
    const auto share = 1.0 / static_cast<double>(blend.targets.count());  // all weights may be 1
    const double least = 0.01 * tolerance * share, least_turn = 0.1 * std::numbers::pi / 180.0 * share;
    const auto drop = [](std::span<glm::vec3> values, double below) {
        for (glm::vec3& value : values)
            if (glm::length(glm::dvec3(value)) < below) value = glm::vec3(0.0f);
    };
    for (std::size_t k = 0; k < blend.targets.count(); ++k) {
        drop(blend.targets.positions(k), least);
        drop(blend.targets.normals(k), least_turn);
    }
}

namespace {

/// The angle between two vectors, which need not be of unit length. Good for small ones too.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Adds a frame's blend to what its entries have at rest.
void add(const Blend& blend, std::size_t frame, std::vector<glm::dvec3>& positions,
         std::vector<glm::dvec3>& normals) {
    const std::size_t count = blend.targets.count();
    for (std::size_t k = 0; k < count; ++k) {
        const auto weight = static_cast<double>(blend.weights[frame * count + k]);
        if (weight == 0.0) continue;
        const auto shifts = blend.targets.positions(k), turns = blend.targets.normals(k);
        for (std::size_t i = 0; i < shifts.size(); ++i) positions[i] += weight * glm::dvec3(shifts[i]);
        for (std::size_t i = 0; i < turns.size(); ++i) normals[i] += weight * glm::dvec3(turns[i]);
    }
}

}  // namespace

BlendError measure(Moves& moves, const Blend& blend) {
    const Rest& rest = moves.rest();
    BlendError error;
    double squares = 0, angles = 0;
    for (std::size_t f = 0; f < moves.count(); ++f) {
        moves.read(f, true);
        std::vector<glm::dvec3> positions(rest.positions.begin(), rest.positions.end()),
            normals(rest.normals.begin(), rest.normals.end());
        add(blend, f, positions, normals);
        for (std::size_t i = 0; i < rest.entries(); ++i) {
            const double off = glm::distance(positions[i], glm::dvec3(moves.positions()[i]));
            error.max = std::max(error.max, off);
            squares += off * off;
            if (rest.normals.empty() || rest.normals[i] == glm::vec3(0.0f)) continue;
            const double angle = angle_between(normals[i], glm::dvec3(moves.normals()[i]));
            error.max_angle = std::max(error.max_angle, angle);
            angles += angle * angle;
        }
    }
    const double all = static_cast<double>(moves.count()) * static_cast<double>(rest.entries());
    error.rms = std::sqrt(squares / all);
    error.rms_angle = std::sqrt(angles / all);
    return error;
}

}  // namespace goffer::clip
