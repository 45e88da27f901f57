// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace goffer::view {
namespace {

constexpr float margin = 0.92f;   // where the outermost point is, as a share of half the width or height
constexpr float nearest = 0.02f;  // least distance from the eye to a point; the scene is 2 long

glm::vec3 unit(const glm::vec3& v) {
    const glm::dvec3 d(v);  // in double, no length is too small or too large
    return glm::vec3(d / glm::length(d));
}

glm::vec3 upright(const glm::vec3& up, const glm::vec3& forward) {
    const glm::vec3 across = glm::cross(forward, unit(up));
    if (glm::length(across) > 1e-3f) return across;
    return glm::cross(forward, std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
}

// Along one axis of the picture, a point p is inside where |p - c| <= t (depth - eye depth). Over all points
// that is c - t e >= high and -c - t e >= low: `mid` is the best c, and `depth` the largest e.
struct Fit {
    float mid, depth;
};

Fit fit(std::span<const glm::vec3> points, const glm::vec3& axis, const glm::vec3& forward, float tangent) {
    float high = -std::numeric_limits<float>::infinity();
    float low = high;
    for (const glm::vec3& p : points) {
        const float across = glm::dot(p, axis);
        const float depth = tangent * glm::dot(p, forward);
        high = std::max(high, across - depth);
        low = std::max(low, -across - depth);
    }
    return {(high - low) / 2, -(high + low) / (2 * tangent)};
}

/// A camera that has yet to be put in its place.
View turned(const Camera& camera, float aspect) {
    const auto length = [](const glm::vec3& v) { return glm::length(glm::dvec3(v)); };
    if (!(length(camera.toward) > 0) || !std::isfinite(length(camera.toward)))
        throw Error("the camera looks nowhere; give a finite vector other than 0 as toward");
    if (!(length(camera.up) > 0) || !std::isfinite(length(camera.up)))
        throw Error("the camera has no up; give a finite vector other than 0");
    if (!(camera.field_of_view >= 0.01f && camera.field_of_view <= 3.0f))
        throw Error("the camera's field of view is out of range; give 0.01 to 3 rad");

    View view{};
    view.forward = unit(camera.toward);
    view.right = unit(upright(camera.up, view.forward));
    view.up = glm::cross(view.right, view.forward);
    view.tangent.y = std::tan(camera.field_of_view / 2);
    view.tangent.x = view.tangent.y * aspect;
    return view;
}

}  // namespace

Ray View::ray(const glm::vec2& place) const {
    const glm::vec3 toward = forward + place.x * tangent.x * right + place.y * tangent.y * up;
    const glm::vec2 step = pixel * tangent / glm::length(toward);
    return {eye, glm::normalize(toward), std::numeric_limits<float>::infinity(), step.x * right, step.y * up};
}

View frame(const Camera& camera, std::span<const glm::vec3> points, float aspect) {
    View view = turned(camera, aspect);
    const Fit x = fit(points, view.right, view.forward, margin * view.tangent.x);
    const Fit y = fit(points, view.up, view.forward, margin * view.tangent.y);
    float first = std::numeric_limits<float>::infinity();
    for (const glm::vec3& p : points) first = std::min(first, glm::dot(p, view.forward));
    view.eye =
        x.mid * view.right + y.mid * view.up + std::min({x.depth, y.depth, first - nearest}) * view.forward;
    return view;
}

std::vector<glm::vec3> deciding_points(const Camera& camera, std::span<const glm::vec3> points,
                                       float aspect) {
    const View view = turned(camera, aspect);
    const glm::dvec3 forward(view.forward), right(view.right), up(view.up);
    const auto x = static_cast<double>(margin * view.tangent.x),
               y = static_cast<double>(margin * view.tangent.y);
    const std::array<glm::dvec3, 11> ways = {
        right - x * forward, -right - x * forward, up - y * forward, -up - y * forward, -forward,
        glm::dvec3(1, 0, 0), {-1, 0, 0},           {0, 1, 0},        {0, -1, 0},        {0, 0, 1},
        {0, 0, -1}};
    std::vector<glm::vec3> farthest;
    if (points.empty()) return farthest;
    farthest.reserve(ways.size());
    for (const glm::dvec3& way : ways)
        farthest.push_back(*std::ranges::max_element(
            points, {}, [&](const glm::vec3& point) { return glm::dot(glm::dvec3(point), way); }));
    return farthest;
}

}  // namespace goffer::view
