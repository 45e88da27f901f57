// SPDX-License-Identifier: MIT
#include "motion/path.hpp"

#include "arguments.hpp"
#include "motion/spline.hpp"
#include "report.hpp"

#include <glm/geometric.hpp>
#define GLM_ENABLE_EXPERIMENTAL  // GLM 1.0 asks for it where glm::rotation() is
#include <glm/gtx/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::cli {
namespace {

using glm::dmat3;
using glm::dvec3;

/// The angle by which `a` turns to `b` about `axis`, all of unit length and both across it.
double angle_about(const dvec3& axis, const dvec3& a, const dvec3& b) {
    return std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
}

/// A direction across `axis`.
dvec3 across(const dvec3& axis) {
    const dvec3 other = std::fabs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, other));
}

/// `axes` turned as little as possible until the third one is `heading`.
dmat3 turned_to(const dmat3& axes, const dvec3& heading) {
    if (glm::dot(axes[2], heading) < -1 + 1e-12) return {axes[0], -axes[1], -axes[2]};
    return glm::mat3_cast(glm::rotation(axes[2], heading)) * axes;
}

}  // namespace

Path::Path(const PathWords& words, const std::string& where) {
    std::vector<dvec3> points = sampled(words);
    closed_ = words.closed || points.front() == points.back();
    if (closed_) points.push_back(points.front());
    for (const dvec3& point : points) {
        const double step = points_.empty() ? 0 : glm::distance(points_.back(), point);
        if (!points_.empty() && step == 0) continue;
        along_.push_back(points_.empty() ? 0 : along_.back() + step);
        if (!points_.empty()) headings_.push_back((point - points_.back()) / step);
        points_.push_back(point);
    }
    if (points_.size() < 2) throw InputError(where + ": all points are the same; give a path some length");
    turns_.emplace_back(1, 0, 0, 0);
    for (std::size_t i = 1; i < headings_.size(); ++i)
        turns_.push_back(glm::normalize(glm::rotation(headings_[i - 1], headings_[i]) * turns_.back()));
    if (!closed_) return;
    const dvec3 side = across(headings_.front());
    const glm::dquat last = glm::rotation(headings_.back(), headings_.front()) * turns_.back();
    twist_ = angle_about(headings_.front(), side, last * side);
}

std::size_t Path::piece_at(double along) const {
    const auto after = std::ranges::upper_bound(along_, along);
    const auto piece = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - along_.begin() - 1, 0));
    return std::min(piece, headings_.size() - 1);
}

dvec3 Path::point_at(double along) const {
    const std::size_t piece = piece_at(along);
    return points_[piece] + (along - along_[piece]) * headings_[piece];
}

/// Points from `start` on, as seen from there, for a body of that length.
std::vector<glm::vec3> Path::window(double start, double length) const {
    const dvec3 from = point_at(start);
    const double enough = start + 2 * length;
    std::vector<glm::vec3> points{glm::vec3(0)};
    std::size_t piece = piece_at(start);
    for (double round = 0; round + along_[piece + 1] < enough; ++piece) {
        const dvec3 end = points_[piece + 1] - from;
        if (round + along_[piece + 1] > start + 1e-9 * this->length()) points.emplace_back(end);
        const bool last = piece + 1 == headings_.size();
        if (last && !closed_) {
            points.emplace_back(end + std::max(enough - along_.back(), length) * headings_.back());
            return points;
        }
        if (!last) continue;
        round += along_.back();
        piece = static_cast<std::size_t>(-1);
    }
    points.emplace_back(points_[piece + 1] - from);
    return points;
}

bend::PathFit Path::lay(const bend::Body& body, double start, std::span<bend::Pose> poses) const {
    if (closed_) {
        constexpr double rounding = 1e-9;
        if (length() < body.length() * (1 - rounding))
            throw InputError("a body of a length of " + number(body.length()) +
                             " does not fit on a closed path of " + number(length()) +
                             "; give a longer path, or scale it");
        start = std::fmod(start, length());
        if (start < 0) start += length();
    }
    const std::size_t piece = piece_at(start);
    const glm::dquat untwisted = glm::angleAxis(-twist_ * start / length(), headings_[piece]);
    const dvec3 side = untwisted * turns_[piece] * turned_to(body.axes(), headings_.front())[0];
    bend::PathFit fit = bend::poses_along(body, window(start, body.length()), poses,
                                          {.model_up = glm::vec3(body.axes()[0]), .up = glm::vec3(side)});
    fit.transform[3] = glm::vec3(dvec3(fit.transform[3]) + point_at(start));
    return fit;
}

}  // namespace goffer::cli
