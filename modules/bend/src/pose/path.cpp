// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "pose/bezier.hpp"
#include "pose/center_samples.hpp"
#include "pose/polyline.hpp"

#include <goffer/bend/path.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace goffer::bend {
namespace {

using glm::dvec3;

bool is_finite(const glm::vec3& p) noexcept {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Turns `axes` as little as possible, so that the third one becomes `direction`.
glm::dmat3 turned_to(const glm::dmat3& axes, const dvec3& direction) noexcept {
    const dvec3 across = glm::cross(axes[2], direction);
    const double cosine = glm::dot(axes[2], direction);
    if (cosine < -1 + 1e-12) return {axes[0], -axes[1], -axes[2]};
    const auto turn = [&](const dvec3& v) {  // Rodrigues' formula
        return cosine * v + glm::cross(across, v) + glm::dot(across, v) / (1 + cosine) * across;
    };
    return {turn(axes[0]), turn(axes[1]), direction};
}

/// `axes` rolled about the third one, so that the direction `model_up`, which has the components (x, y) along
/// the others, points as nearly to `up` as it can.
glm::dmat3 rolled_to(const glm::dmat3& axes, const glm::dvec2& model_up, const dvec3& up) noexcept {
    const glm::dvec2 wanted(glm::dot(axes[0], up), glm::dot(axes[1], up));
    const double lengths = glm::length(model_up) * glm::length(wanted);
    if (!(lengths > 0)) return axes;
    const double cosine = glm::dot(model_up, wanted) / lengths;
    const double sine = (model_up.x * wanted.y - model_up.y * wanted.x) / lengths;
    return {cosine * axes[0] + sine * axes[1], cosine * axes[1] - sine * axes[0], axes[2]};
}

/// `v` with a length of 1, or zero if it has no direction, or hardly one across `axis`.
dvec3 across(const glm::vec3& v, const dvec3& axis) noexcept {
    constexpr double least = 1e-6;
    if (!is_finite(v)) return dvec3(0);
    const dvec3 unit = glm::dvec3(v) / std::max(glm::length(glm::dvec3(v)), 1e-300);
    const dvec3 part = unit - glm::dot(unit, axis) * axis;
    return glm::length(part) > least ? part : dvec3(0);
}

/// `m` as a rotation free of rounding, or the identity if `m` is hardly one.
glm::dmat3 rotation_of(const glm::mat3& m) noexcept {
    constexpr float most = 0.01f;
    for (int c = 0; c < 3; ++c) {
        for (int other = 0; other < 3; ++other) {
            if (!(std::fabs(glm::dot(m[c], m[other]) - (c == other ? 1.0f : 0.0f)) < most))
                return glm::dmat3(1);
        }
    }
    if (glm::determinant(m) < 0) return glm::dmat3(1);
    const dvec3 x = glm::normalize(dvec3(m[0]));
    const dvec3 z = glm::normalize(glm::cross(x, dvec3(m[1])));
    return {x, glm::cross(z, x), z};
}

/// The axes of `body` where its own one has the direction `heading`, turned and rolled as `start` has it.
glm::dmat3 axes_along(const Body& body, const dvec3& heading, const PathStart& start) noexcept {
    const glm::dmat3 axes = turned_to(rotation_of(start.before) * body.axes(), heading);
    const dvec3 local = across(start.model_up, body.axes()[2]) * body.axes();
    return rolled_to(axes, {local.x, local.y}, across(start.up, heading));
}

double distance_of(const PathStart& start) noexcept {
    return start.distance > 0 && std::isfinite(start.distance) ? static_cast<double>(start.distance) : 0;
}

/// How a region bends: by `angle`, toward (`cosine`, `sine`) in its frame.
struct Bend {
    double angle, cosine, sine;
    bool clamped;
};

/// The bend from the axis of `axes` to `heading`, by at most `most`. None if `heading` is zero.
Bend bend_toward(const glm::dmat3& axes, const dvec3& heading, double most) noexcept {
    const dvec3 local = heading * axes;  // components along the axes
    const double across = std::sqrt(local.x * local.x + local.y * local.y);
    const double wanted = std::atan2(across, local.z), angle = std::min(wanted, most);
    if (across == 0) return {angle, 1, 0, wanted > most};
    return {angle, local.x / across, local.y / across, wanted > most};
}

/// A frame that moves along the body's center line.
struct MovingFrame {
    dvec3 point;
    glm::dmat3 axes;
};

/// Moves to the end of a region whose center line has `length` and bends by `bend`. Returns the samples
/// between.
CenterSamples advance(MovingFrame& frame, const Bend& bend, double length) noexcept {
    const dvec3 n = bend.cosine * frame.axes[0] + bend.sine * frame.axes[1];
    const dvec3 b = bend.cosine * frame.axes[1] - bend.sine * frame.axes[0];
    const dvec3 t = frame.axes[2];
    const Arc arc(bend.angle);
    const CenterSamples samples(frame.point, length, n, t, arc);
    const double sine = arc.sine[Arc::doublings], versine = arc.versine[Arc::doublings];
    const dvec3 turned_n = n - versine * n - sine * t;
    frame.axes = {bend.cosine * turned_n - bend.sine * b, bend.sine * turned_n + bend.cosine * b,
                  t + sine * n - versine * t};
    frame.point += length / arc.angle * (versine * n + sine * t);
    return samples;
}

/// An approximation of the angle from the axis of `axes` to `heading`, at most `most`: within a hundredth of
/// it up to a right angle.
double about_angle(const glm::dmat3& axes, const dvec3& heading, double most) noexcept {
    const dvec3 local = heading * axes;
    const double square = local.x * local.x + local.y * local.y;
    // The tangent of half the angle is across / onward; a quotient of polynomials stands in for the arc
    // tangent.
    const double across = std::sqrt(square), onward = std::sqrt(square + local.z * local.z) + local.z;
    const double above = 2 * across * (15 * onward * onward + 4 * square);
    const double below = onward * (15 * onward * onward + 9 * square);
    return std::min(above / std::max(below, min_square), most);
}

/// How far ahead on `path` a region of `length` ends: by the length of its center line. That is shorter than
/// the region by angle * radius, and the angle depends on where the region ends. Improves `guess` by one
/// step.
template <class Path>
double end_of_region(Path& path, const glm::dmat3& axes, double guess, double length, double radius,
                     double most) noexcept {
    const double angle = about_angle(axes, path.heading(guess), most);
    return guess * length / (guess + angle * radius);  // Newton's step for constant curvature
}

/// A body that goes straight on from `start`, unturned.
PathFit straight(const Body& body, const dvec3& start, std::span<Pose> poses) noexcept {
    std::ranges::fill(poses, Pose{});
    PathFit fit;
    fit.transform[3] = glm::vec3(start - body.origin());
    return fit;
}

PathFit no_fit(std::span<Pose> poses) noexcept {
    std::ranges::fill(poses, Pose{});
    return {.error = std::numeric_limits<float>::infinity()};
}

glm::mat4x3 transform_to(const MovingFrame& frame, const Body& body) noexcept {
    const glm::dmat3 turn = frame.axes * glm::transpose(body.axes());
    glm::mat4x3 transform{glm::mat3(turn)};
    transform[3] = glm::vec3(frame.point - turn * body.origin());
    return transform;
}

template <class Path>
PathFit follow(const Body& body, Path path, std::span<Pose> poses, const PathStart& start) noexcept {
    const dvec3 heading = path.heading(0);
    if (heading == dvec3(0)) return straight(body, path.place(), poses);
    MovingFrame frame{path.place(), axes_along(body, glm::normalize(heading), start)};
    PathFit fit{.transform = transform_to(frame, body)};
    double farthest = 0, share = 1;  // share: center line / length of the last region
    const std::span<const Region> regions = body.regions();
    const BodyData& data = *body.data();
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const auto length = static_cast<double>(regions[r].length);
        const auto most = static_cast<double>(regions[r].max_angle);
        const double radius = radius_of(data.inputs[r], data.radius);
        double ahead = share * length;
        for (int steps = r == 0 ? 2 : 1; steps > 0; --steps)
            ahead = end_of_region(path, frame.axes, ahead, length, radius, most);
        const Bend bend = bend_toward(frame.axes, path.heading(ahead), most);
        poses[r] = {static_cast<float>(bend.angle), static_cast<float>(std::atan2(bend.sine, bend.cosine))};
        fit.clamped = fit.clamped || bend.clamped;
        const double center = length - bend.angle * radius;
        farthest = std::max(farthest, path.advance(advance(frame, bend, center)));
        share = center / length;
    }
    fit.error = static_cast<float>(std::sqrt(farthest));
    return fit;
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
        if (!is_finite(p)) return PathFault::not_finite;
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i] == points[i - 1]) return PathFault::repeated_point;
    }
    return PathFault::none;
}

PathFit poses_along(const Body& body, std::span<const glm::vec3> points, std::span<Pose> poses,
                    const PathStart& start) noexcept {
    if (points.size() < 2 || !std::ranges::all_of(points, is_finite)) return no_fit(poses);
    const Polyline path(points, distance_of(start));
    return follow(body, path, poses.first(std::min(poses.size(), body.region_count())), start);
}

PathFit poses_along_bezier(const Body& body, const glm::vec3 (&control)[4], std::span<Pose> poses,
                           const PathStart& start) noexcept {
    if (!std::ranges::all_of(control, is_finite)) return no_fit(poses);
    const Bezier path(control, distance_of(start));
    return follow(body, path, poses.first(std::min(poses.size(), body.region_count())), start);
}

}  // namespace goffer::bend
