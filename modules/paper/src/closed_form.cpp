// SPDX-License-Identifier: MIT
#include "goffer/paper/closed_form.hpp"

#include "bend.hpp"

#include <goffer/paper/wave.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

namespace goffer::paper {
namespace {

double area_factor(const Parameters& body, double alpha) {
    return area_factor(body.profile, body.folds, body.length, body.radius, alpha);
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

void require_rest(const Parameters& body) {
    static_cast<void>(bend_of(body, {body.rest_angle, body.rest_direction}));  // throws if out of range
    if (!(body.rest_angle >= 0))
        throw std::invalid_argument("rest_angle is negative: turn rest_direction by pi");
    if (!(body.onset >= 0)) throw std::invalid_argument("onset is negative: it must be 0 or more");
    const bool relative = body.rest_angle != 0 || body.onset != 0;
    if (relative && body.amplitude == Amplitude::area) {
        throw std::invalid_argument(
            "amplitude area: no factor is known for a body with a rest arc or an onset");
    }
}

/// The bent frame (n, b, t) at a vertex, in (e_theta, e_theta_perp, e3).
glm::dmat3 bent_frame(double c, double s, double phi) {
    const double cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    return {c * cos_phi,  s, -c * sin_phi,  // n
            -s * cos_phi, c, s * sin_phi,   // b
            sin_phi,      0, cos_phi};      // t
}

/// What the bare bend does to a vector at a vertex: it turns it into `frame` and stretches it along the body.
struct BareBend {
    glm::dmat3 frame;  // in the body frame
    double stretch;

    BareBend(const Cylindrical& at, double length, double radius, const Pose& pose) {
        const Bend bend = bend_of({.length = length, .radius = radius}, pose);
        const double c = std::cos(at.beta - bend.theta), s = std::sin(at.beta - bend.theta);
        frame = bent_frame(c, s, bend.alpha * at.z / length);
        for (int i = 0; i < 3; ++i) frame[i] = turned(frame[i], bend.theta);
        stretch = (1 - bend.kappa()) - bend.alpha / length * at.rho * c;
    }
};

CylindricalVector components(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// w(rho) / rho, finite on the axis.
double weight_per_rho(double rho, double radius) {
    return rho < radius / 2 ? 2 / radius : 1 / rho;
}

}  // namespace

/// The Jacobian at a vertex, from (e_rho, e_beta, e_z) to the bent frame, is upper triangular: rows (outward,
/// across, along), (0, around, 0), (0, 0, stretch).
struct ClosedForm::Local {
    double wrinkle;  // f
    double outward;
    double across;
    double along;
    double around;
    double stretch;
    glm::dmat3 frame;  // the bent frame's axes in (e_theta, e_theta_perp, e3)
};

ClosedForm::ClosedForm(const Parameters& body, const Pose& pose) : body_(body) {
    const Bend bend = bend_of(body, pose);
    require_rest(body);
    alpha_ = bend.alpha;
    theta_ = bend.theta;
    kappa_ = bend.kappa();
    if (body.folds == 0 || body.amplitude == Amplitude::none) return;
    wave_ = std::make_shared<const Wave>(body.profile, body.folds, 2 * kappa_);
    factor_ = body.amplitude == Amplitude::area ? area_factor(body, alpha_) : 1;
}

Column ClosedForm::column(double beta) const {
    if (!wave_) return {};
    if (body_.rest_angle != 0 || body_.onset != 0) return relative_column(beta);
    const Column relative = wave_->column(squeeze(kappa_, beta, theta_));
    const double scale = factor_ * body_.length / 2;
    // sqrt(q) = sqrt(2 kappa) |h|, with the sign of h blended where the amplitude has its corner.
    const double half = (beta - theta_) / 2;
    const double side = std::clamp(std::cos(half) / crease_width, -1.0, 1.0);
    const double root_slope = -std::sqrt(2 * kappa_) * side * std::sin(half) / 2;
    return {scale * relative.amplitude, scale * relative.slope * root_slope};
}

// The column's own length is L S_0, with S_0 its scale at rest; it is squeezed to S / S_0 of that.
Column ClosedForm::relative_column(double beta) const {
    const double rest_kappa = body_.rest_angle * body_.radius / body_.length;
    const double rest_scale = 1 - squeeze(rest_kappa, beta, body_.rest_direction);
    const double rest_slope = rest_kappa * std::sin(beta - body_.rest_direction);
    const double difference = squeeze(kappa_, beta, theta_) - (1 - rest_scale);
    if (difference <= 0) return {};
    const double q = difference / rest_scale;
    const double per_root = 1 / std::sqrt(q + body_.onset);
    const double root = q * per_root;  // of q^2 / (q + q0)
    const double difference_slope = rest_slope - kappa_ * std::sin(beta - theta_);
    const double q_slope = (difference_slope - q * rest_slope) / rest_scale;
    const double root_slope = q_slope * per_root * (1 - q * per_root * per_root / 2);
    const Column relative = wave_->column(root * root);
    const double scale = factor_ * body_.length / 2;
    return {scale * rest_scale * relative.amplitude,
            scale * (rest_scale * relative.slope * root_slope + rest_slope * relative.amplitude)};
}

double ClosedForm::column_amplitude(double beta) const {
    return column(beta).amplitude;
}

double ClosedForm::wrinkle(const Cylindrical& rest) const {
    if (!wave_) return 0;
    const double u = std::abs(2 * rest.z / body_.length - 1);
    return column_amplitude(rest.beta) * shape(body_.profile, body_.folds, u) *
           depth_weight(rest.rho, body_.radius);
}

glm::dvec3 ClosedForm::position(const Cylindrical& rest) const {
    return Bend{body_.length, body_.radius, alpha_, theta_}.position(rest, wrinkle(rest));
}

ClosedForm::Local ClosedForm::local(const Cylindrical& rest) const {
    const double c = std::cos(rest.beta - theta_), s = std::sin(rest.beta - theta_);
    const double phi = alpha_ * rest.z / body_.length;
    Local at{};
    at.frame = bent_frame(c, s, phi);
    at.outward = at.around = 1;
    if (wave_) {
        const Column here = column(rest.beta);
        const double u = std::abs(2 * rest.z / body_.length - 1);
        const double g = shape(body_.profile, body_.folds, u);
        const double weight = depth_weight(rest.rho, body_.radius);
        const double per_rho = weight_per_rho(rest.rho, body_.radius);
        at.wrinkle = here.amplitude * g * weight;
        at.outward += rest.rho < body_.radius / 2 ? here.amplitude * g * per_rho : 0;
        at.around += here.amplitude * g * per_rho;
        at.across = here.slope * g * per_rho;
        at.along = here.amplitude * weight * shape_slope_z(body_.profile, body_.folds, body_.length, rest.z);
    }
    at.stretch = (1 - kappa_) - alpha_ / body_.length * (rest.rho + at.wrinkle) * c;
    return at;
}

// Cofactors of the Jacobian: its inverse transpose times the determinant, without a division.
glm::dvec3 ClosedForm::normal(const Cylindrical& rest, const CylindricalVector& rest_normal) const {
    const Local at = local(rest);
    const glm::dvec3 bent{at.around * at.stretch * rest_normal.rho,
                          at.stretch * (at.outward * rest_normal.beta - at.across * rest_normal.rho),
                          at.around * (at.outward * rest_normal.z - at.along * rest_normal.rho)};
    return unit(turned(at.frame * bent, theta_));
}

glm::dvec3 ClosedForm::tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent) const {
    const Local at = local(rest);
    const glm::dvec3 bent{
        at.outward * rest_tangent.rho + at.across * rest_tangent.beta + at.along * rest_tangent.z,
        at.around * rest_tangent.beta, at.stretch * rest_tangent.z};
    return unit(turned(at.frame * bent, theta_));
}

glm::dvec3 ClosedForm::center(double z) const {
    return Bend{body_.length, body_.radius, alpha_, theta_}.position({0, z, 0}, 0);
}

CylindricalVector straightened_normal(const glm::dvec3& vector, const Cylindrical& at, double length,
                                      double radius, const Pose& rest) {
    const BareBend bend(at, length, radius, rest);
    return components(unit(glm::transpose(bend.frame) * vector * glm::dvec3(1, 1, bend.stretch)));
}

CylindricalVector straightened_tangent(const glm::dvec3& vector, const Cylindrical& at, double length,
                                       double radius, const Pose& rest) {
    const BareBend bend(at, length, radius, rest);
    // Not divided by the stretch, which may be near 0: the direction is what counts.
    return components(unit(glm::transpose(bend.frame) * vector * glm::dvec3(bend.stretch, bend.stretch, 1)));
}

double depth_weight(double rho, double radius) {
    return std::min(1.0, 2 * rho / radius);
}

double shape_slope_z(Profile profile, int folds, double length, double z) {
    const double x = 2 * z / length - 1;
    // Only `damped` has a crease to blend; the slope of `smooth` is odd in x as it is.
    const double side =
        profile == Profile::damped ? std::clamp(x / crease_width, -1.0, 1.0) : std::copysign(1.0, x);
    return side * shape_slope(profile, folds, std::abs(x)) * 2 / length;
}

Cylindrical to_cylindrical(const glm::dvec3& point) {
    const double rho = std::hypot(point.x, point.y);
    return {rho > 0 ? std::atan2(point.y, point.x) : 0, point.z, rho};
}

Cylindrical to_cylindrical(const glm::dvec3& point, double length, double radius, const Pose& rest) {
    const Bend bend = bend_of({.length = length, .radius = radius}, rest);
    constexpr double full_turn = 2 * std::numbers::pi;
    if (!(bend.alpha < full_turn)) {
        throw std::invalid_argument("angle is " + std::to_string(rest.angle) +
                                    " rad: a body bent at rest must stay below a full turn, 2 pi");
    }
    return bend.inverse(point);
}

glm::dvec3 from_cylindrical(const Cylindrical& point) {
    return {point.rho * std::cos(point.beta), point.rho * std::sin(point.beta), point.z};
}

}  // namespace goffer::paper
