// SPDX-License-Identifier: MIT
#pragma once

#include "pose/center_samples.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace goffer::bend {

/// A walk along a polyline, by length. Beyond its end the path goes straight on. Has at least one point.
/// Points are finite; neighbors may be equal.
class Polyline {
public:
    /// Begins at the distance `start` >= 0 from the first point.
    Polyline(std::span<const glm::vec3> points, double start) noexcept
        : points_(without_repeated_end(points)), gone_(start) {
        here_ = piece(0, 0);
        move(here_, gone_);
        near_ = here_;
    }

    /// The current place.
    [[nodiscard]] glm::dvec3 place() const noexcept {
        const double length = here_.end - here_.begin;
        return length > 0 ? here_.from + (gone_ - here_.begin) / length * here_.step : here_.from;
    }
    /// The direction at the distance `ahead` >= 0 in front of the current place, as a vector of any length.
    /// It is zero if all points are equal.
    [[nodiscard]] glm::dvec3 heading(double ahead) const noexcept {
        Piece at = here_;
        while (!is_last(at) && (at.end < gone_ + ahead || at.square == 0)) at = next(at);
        return at.step;
    }
    /// Moves on by the length of a region. Returns the largest squared distance of its samples from the path.
    /// The foot of each place is searched near that of the place before it and up to half a region beyond, so
    /// each piece is looked at for a few places only.
    [[nodiscard]] double advance(const CenterSamples& samples) noexcept;

private:
    /// From a point to the next.
    struct Piece {
        std::size_t index;
        glm::dvec3 from, step;
        double square;      // of its length
        double begin, end;  // along the polyline
    };
    /// The point of the path that is nearest to a place.
    struct Foot {
        double along;
        double square;  // of the distance
    };

    static std::span<const glm::vec3> without_repeated_end(std::span<const glm::vec3> points) noexcept {
        std::size_t count = points.size();
        while (count > 1 && points[count - 1] == points[count - 2]) --count;
        return points.first(count);
    }

    [[nodiscard]] Piece piece(std::size_t index, double begin) const noexcept {
        const glm::dvec3 from(points_[index]);
        const glm::dvec3 step = glm::dvec3(points_[std::min(index + 1, points_.size() - 1)]) - from;
        const double square = glm::dot(step, step);
        return {index, from, step, square, begin, begin + std::sqrt(square)};
    }
    [[nodiscard]] Piece next(const Piece& at) const noexcept { return piece(at.index + 1, at.end); }
    [[nodiscard]] bool is_last(const Piece& at) const noexcept { return at.index + 2 >= points_.size(); }
    void move(Piece& at, double to) const noexcept {
        while (!is_last(at) && at.end < to) at = next(at);
    }
    [[nodiscard]] Foot foot_on(const Piece& at, const glm::dvec3& place) const noexcept;
    [[nodiscard]] Foot foot(const glm::dvec3& place, double ahead) const noexcept;

    std::span<const glm::vec3> points_;
    double gone_ = 0;  // length up to the current place
    Piece here_;       // the current place is on it
    Piece near_;       // where the next foot is searched from
};

inline Polyline::Foot Polyline::foot_on(const Piece& at, const glm::dvec3& place) const noexcept {
    const double most = is_last(at) ? std::numeric_limits<double>::infinity() : 1.0;
    const double t =
        std::clamp(glm::dot(place - at.from, at.step) / std::max(at.square, min_square), 0.0, most);
    const glm::dvec3 away = at.from + t * at.step - place;
    return {at.begin + t * (at.end - at.begin), glm::dot(away, away)};
}

/// Searches from near_ on, until a stretch of `ahead` has brought nothing nearer.
inline Polyline::Foot Polyline::foot(const glm::dvec3& place, double ahead) const noexcept {
    Piece at = near_;
    Foot nearest = foot_on(at, place);
    while (!is_last(at) && at.end <= nearest.along + ahead) {
        at = next(at);
        const Foot other = foot_on(at, place);
        if (other.square <= nearest.square) nearest = other;
    }
    return nearest;
}

inline double Polyline::advance(const CenterSamples& samples) noexcept {
    const double step = samples.length / CenterSamples::count;
    double farthest = 0;
    for (int i = 0; i < CenterSamples::count; ++i) {
        move(near_, gone_ + i * step - samples.length);
        const Foot nearest = foot(samples[i], 8 * step);
        farthest = std::max(farthest, nearest.square);
        move(near_, nearest.along - 2 * step);
    }
    gone_ += samples.length;
    move(here_, gone_);
    return farthest;
}

}  // namespace goffer::bend
