// SPDX-License-Identifier: MIT
#include "bend.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace goffer::paper {
namespace {

double sinc(double x) {
    return x == 0 ? 1 : std::sin(x) / x;
}

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    throw std::invalid_argument(text.str());
}

void require(const Parameters& body, const Pose& pose) {
    if (!(body.length > 0 && std::isfinite(body.length)))
        refuse("length is ", body.length, ": it must be a positive number");
    if (!(body.radius > 0 && std::isfinite(body.radius)))
        refuse("radius is ", body.radius, ": it must be a positive number");
    if (body.folds.count < 0) refuse("folds is ", body.folds.count, ": it must be 0 (no wrinkle) or more");
    if (!(std::abs(pose.angle) < body.length / (2 * body.radius))) {
        refuse("angle is ", pose.angle,
               " rad: it must be below length / (2 radius) = ", body.length / (2 * body.radius));
    }
    if (!std::isfinite(pose.direction))
        refuse("direction is ", pose.direction, ": it must be a finite number of radians");
}

}  // namespace

Bend bend_of(const Parameters& body, const Pose& pose) {
    require(body, pose);
    const double theta = pose.angle < 0 ? pose.direction + std::numbers::pi : pose.direction;
    return {body.length, body.radius, std::abs(pose.angle), theta};
}

// Eq 2-5 give the center line X = z (1 - cos phi) / phi, Z = z sin phi / phi, both times 1 - kappa, and the
// turned cross-section on it. The displacement from rest is computed, which vanishes with alpha to the last
// bit.
glm::dvec3 Bend::position(const Cylindrical& rest, double wrinkle) const {
    const double c = std::cos(rest.beta - theta), s = std::sin(rest.beta - theta);
    const double phi = alpha * rest.z / length;
    const double half_sine = std::sin(phi / 2), half_sinc = sinc(phi / 2);
    const double x = rest.z * phi / 2 * half_sinc * half_sinc;
    const double z = rest.z * sinc(phi);
    const double out = (rest.rho + wrinkle) * c;
    return from_cylindrical(rest) + turned({(1 - kappa()) * x + wrinkle * c - 2 * out * half_sine * half_sine,
                                            wrinkle * s, (z - rest.z) - kappa() * z - out * std::sin(phi)},
                                           theta);
}

// In the bend plane, with k the curvature of the center line, the arc's center lies at x = 1 / k. The
// distance from there, and the angle about it, are computed times k, and the distance d from the center line
// as the displacement d - x, so that nothing cancels and all of it vanishes with alpha to the last bit.
Cylindrical Bend::inverse(const glm::dvec3& point) const {
    const double c = std::cos(theta), s = std::sin(theta);
    const double x = c * point.x + s * point.y;
    const double curvature = alpha / ((1 - kappa()) * length);
    const double inward = 1 - curvature * x, along = curvature * point.z;
    const double squared = x * x + point.z * point.z;
    const double far = 1 + std::hypot(inward, along);
    const double d = (2 * x - curvature * squared) / far;
    const double shift = curvature * (x * d - squared) / far;
    Cylindrical rest = to_cylindrical(point + glm::dvec3{c * shift, s * shift, 0});
    constexpr double none = 1e-100;  // so small that z is the point's own, to the last bit
    if (alpha < none) return rest;
    double phi = std::atan2(along, inward);
    if (phi < alpha / 2 - std::numbers::pi) phi += 2 * std::numbers::pi;
    rest.z = phi / alpha * length;
    return rest;
}

glm::dvec3 turned(const glm::dvec3& vector, double theta) {
    const double c = std::cos(theta), s = std::sin(theta);
    return {c * vector.x - s * vector.y, s * vector.x + c * vector.y, vector.z};
}

}  // namespace goffer::paper
