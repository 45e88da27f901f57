// SPDX-License-Identifier: MIT
#include <goffer/bend/path.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace goffer::bend {
namespace {

using glm::dvec3;

/// A polyline by the length along it. Beyond the end it goes straight on.
class Polyline {
public:
    explicit Polyline(std::span<const glm::vec3> points) noexcept : points_(points) {}

    struct Place {
        dvec3 point, direction;
    };

    /// `along` >= that of the call before.
    [[nodiscard]] Place at(double along) noexcept {
        for (; piece_ + 2 < points_.size(); ++piece_) {
            const double length = glm::length(step());
            if (along <= before_ + length) break;
            before_ += length;
        }
        const dvec3 direction = glm::normalize(step());
        return {dvec3(points_[piece_]) + (along - before_) * direction, direction};
    }

private:
    [[nodiscard]] dvec3 step() const noexcept { return dvec3(points_[piece_ + 1]) - dvec3(points_[piece_]); }

    std::span<const glm::vec3> points_;
    std::size_t piece_ = 0;
    double before_ = 0;  // length of the pieces before
};

/// The distance from `point` to the polyline.
double distance(const dvec3& point, std::span<const glm::vec3> points) noexcept {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const dvec3 a(points[i]), step = dvec3(points[i + 1]) - a;
        const bool last = i + 2 == points.size();  // goes straight on
        const double most = last ? std::numeric_limits<double>::infinity() : 1.0;
        const double t = std::clamp(glm::dot(point - a, step) / glm::dot(step, step), 0.0, most);
        nearest = std::min(nearest, glm::length(a + t * step - point));
    }
    return nearest;
}

/// An orthonormal frame whose third axis is `direction`, turned as little as possible from `axes`.
glm::dmat3 turned_to(const glm::dmat3& axes, const dvec3& direction) noexcept {
    const dvec3 across = glm::cross(axes[2], direction);
    const double cosine = glm::dot(axes[2], direction);
    if (cosine < -1 + 1e-12) return {axes[0], -axes[1], -axes[2]};
    const auto turn = [&](const dvec3& v) {  // Rodrigues' formula for the shortest turn
        return cosine * v + glm::cross(across, v) + glm::dot(across, v) / (1 + cosine) * across;
    };
    return {turn(axes[0]), turn(axes[1]), direction};
}

/// A frame on the way along the body.
struct Way {
    dvec3 point;
    glm::dmat3 axes;
};

/// `share` of the way along a region that begins at `from`.
Way along(const Way& from, const Pose& pose, double length, double radius, double share) noexcept {
    const double alpha = static_cast<double>(pose.angle), theta = static_cast<double>(pose.direction);
    const double kappa = alpha * radius / length, phi = alpha * share;
    const double arc = (1 - kappa) * length * share;
    const double half = phi / 2, sinc = half != 0 ? std::sin(half) / half : 1;
    const dvec3 n = std::cos(theta) * from.axes[0] + std::sin(theta) * from.axes[1];
    const dvec3 b = std::cos(theta) * from.axes[1] - std::sin(theta) * from.axes[0];
    const dvec3 t = from.axes[2];
    const dvec3 turned_n = std::cos(phi) * n - std::sin(phi) * t;
    const dvec3 turned_t = std::sin(phi) * n + std::cos(phi) * t;
    return {from.point + arc * sinc * (std::sin(half) * n + std::cos(half) * t),
            {std::cos(theta) * turned_n - std::sin(theta) * b,
             std::sin(theta) * turned_n + std::cos(theta) * b, turned_t}};
}

/// The pose that turns the axis of `axes` to `direction`, at most by `most`.
Pose towards(const glm::dmat3& axes, const dvec3& direction, float most, bool& clamped) noexcept {
    const dvec3 local = glm::transpose(axes) * direction;
    const double angle = std::atan2(std::hypot(local.x, local.y), local.z);
    clamped = clamped || angle > static_cast<double>(most);
    return {std::min(static_cast<float>(angle), most), static_cast<float>(std::atan2(local.y, local.x))};
}

}  // namespace

std::string_view describe(PathFault fault) noexcept {
    switch (fault) {
        case PathFault::none:
            return "no fault";
        case PathFault::too_few_points:
            return "path: fewer than two points";
        case PathFault::not_finite:
            return "path: a point is not finite";
        case PathFault::repeated_point:
            return "path: a point repeats the one before it; leave it out";
    }
    return "unknown fault";
}

PathFault check_path(std::span<const glm::vec3> points) noexcept {
    if (points.size() < 2) return PathFault::too_few_points;
    for (const glm::vec3& p : points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return PathFault::not_finite;
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i] == points[i - 1]) return PathFault::repeated_point;
    }
    return PathFault::none;
}

PathFit poses_along(const Body& body, std::span<const glm::vec3> points, std::span<Pose> poses) noexcept {
    constexpr int places = 16;
    PathFit fit;
    Polyline path(points);
    const Polyline::Place start = path.at(0);
    Way way{start.point, turned_to(body.axes(), start.direction)};
    const glm::dmat3 turn = way.axes * glm::transpose(body.axes());
    fit.transform = glm::mat4x3(glm::mat3(turn));
    fit.transform[3] = glm::vec3(start.point - turn * body.origin());
    double reached = 0, error = 0;
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const double length = static_cast<double>(body.regions()[r].length);
        const float most = body.max_angle(r);
        // The centre line is shorter than the region by what the region bends; which depends on where it
        // ends.
        double ahead = length;
        for (int step = 0; step < 3; ++step) {
            Polyline from_here = path;
            bool ignored = false;
            poses[r] = towards(way.axes, from_here.at(reached + ahead).direction, most, ignored);
            ahead = length - static_cast<double>(poses[r].angle) * body.radius();
        }
        reached += ahead;
        poses[r] = towards(way.axes, path.at(reached).direction, most, fit.clamped);
        for (int i = 1; i <= places; ++i) {
            const Way here = along(way, poses[r], length, body.radius(), static_cast<double>(i) / places);
            error = std::max(error, distance(here.point, points));
        }
        way = along(way, poses[r], length, body.radius(), 1);
    }
    fit.error = static_cast<float>(error);
    return fit;
}

PathFit poses_along_bezier(const Body& body, const glm::vec3 (&control)[4], std::span<Pose> poses) noexcept {
    constexpr int pieces = 256;
    glm::vec3 points[pieces + 1];
    for (int i = 0; i <= pieces; ++i) {
        const float t = static_cast<float>(i) / pieces, u = 1 - t;
        points[i] = u * u * u * control[0] + 3 * u * u * t * control[1] + 3 * u * t * t * control[2] +
                    t * t * t * control[3];
    }
    return poses_along(body, points, poses);
}

}  // namespace goffer::bend
