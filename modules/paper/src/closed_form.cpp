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
    return area_factor(body.profile, body.folds.total, body.length, body.radius, alpha);
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
    if ((relative || body.shape) && body.amplitude == Amplitude::area) {
        throw std::invalid_argument(
            "amplitude area: no factor is known for a body with a rest arc, an onset or a shape");
    }
}

void require_folds(const Parameters& body) {
    const FoldRange& folds = body.folds;
    if (folds.whole()) return;  // what a Wave looks at
    if (folds.count < 1 || folds.before < 0 || folds.before > folds.total - folds.count)
        throw std::invalid_argument("folds: those of the region do not lie in its wave");
    if (body.profile.kind != Profile::Kind::even || body.amplitude == Amplitude::area)
        throw std::invalid_argument("folds: only even ones run on over joints, and not with amplitude area");
}

void require_shape(const Parameters& body, double alpha) {
    if (!body.shape) return;
    if (!(std::abs(body.shape->radius() / body.radius - 1) < 1e-9))
        throw std::invalid_argument("radius is not that of the shape");
    const double thickest = body.shape->radius() * body.shape->max_scale();
    if (!(std::max(alpha, body.rest_angle) < body.length / (2 * thickest)))
        throw std::invalid_argument("angle: the body is too thick for it, where it is thickest");
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

    BareBend(const Cylindrical& at, double length, double radius, const Pose& pose, const Shape* shape) {
        const Bend bend = bend_of({.length = length, .radius = radius}, pose);
        const double c = std::cos(at.beta - bend.theta), s = std::sin(at.beta - bend.theta);
        const double curvature = bend.alpha / length;
        frame = bent_frame(c, s, curvature * (at.z - (shape ? curvature * shape->drift(at.z) : 0)));
        for (int i = 0; i < 3; ++i) frame[i] = turned(frame[i], bend.theta);
        stretch = (1 - bend.kappa()) - curvature * at.rho * c;
        if (shape) stretch *= 1 - bend.kappa() * (shape->scale(at.z) - 1);
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

/// The shape of the body about a vertex.
struct ClosedForm::LocalShape {
    double scale, scale_slope;  // s = r(z) / r, ds/dz
    double wave, wave_slope;    // g w, d(g w)/dz
    double wave_per_rho;        // g w / rho
    bool inner;                 // w depends on rho
    double arc_z;               // height of the place on a cylinder that has the same arc angle
};

/// The Jacobian at a vertex, from (e_rho, e_beta, e_z) to the bent frame, is upper triangular: rows (outward,
/// across, along), (0, around, 0), (0, 0, stretch).
struct ClosedForm::Local {
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
    require_folds(body);
    alpha_ = bend.alpha;
    theta_ = bend.theta;
    kappa_ = bend.kappa();
    require_shape(body, alpha_);
    if (body.folds.count == 0 || body.amplitude == Amplitude::none) return;
    const double max_scale = body.shape ? body.shape->max_scale() : 1;
    wave_ = std::make_shared<const Wave>(body.profile, body.folds.total,
                                         std::min(2 * kappa_ * max_scale, 0.9999));
    factor_ = body.amplitude == Amplitude::area ? area_factor(body, alpha_) : 1;
}

Depth ClosedForm::depth(double beta, double scale) const {
    if (!wave_) return {};
    if (body_.rest_angle != 0 || body_.onset != 0) return relative_depth(beta, scale);
    const double kappa = kappa_ * scale;
    const Column relative = wave_->column(squeeze(kappa, beta, theta_));
    const double size = factor_ * half_wave();
    // sqrt(q) = sqrt(2 kappa) |h|, with the sign of h blended where the amplitude has its corner.
    const double half = (beta - theta_) / 2, h = std::cos(half);
    const double side = std::clamp(h / crease_width, -1.0, 1.0);
    const double root_slope = -std::sqrt(2 * kappa) * side * std::sin(half) / 2;
    const double root_by_scale = std::sqrt(2 * kappa) * std::abs(h) / (2 * scale);
    return {size * relative.amplitude, size * relative.slope * root_slope,
            size * relative.slope * root_by_scale};
}

// The column's own length is L S_0, with S_0 its scale at rest; it is squeezed to S / S_0 of that.
Depth ClosedForm::relative_depth(double beta, double scale) const {
    const double kappa = kappa_ * scale;
    const double rest_kappa = body_.rest_angle * body_.radius / body_.length * scale;
    const double rest_scale = 1 - squeeze(rest_kappa, beta, body_.rest_direction);
    const double rest_slope = rest_kappa * std::sin(beta - body_.rest_direction);
    const double difference = squeeze(kappa, beta, theta_) - (1 - rest_scale);
    if (difference <= 0) return {};
    const double q = difference / rest_scale;
    const double per_root = 1 / std::sqrt(q + body_.onset);
    const double root = q * per_root;  // of q^2 / (q + q0)
    const double difference_slope = rest_slope - kappa * std::sin(beta - theta_);
    const double q_slope = (difference_slope - q * rest_slope) / rest_scale;
    const double root_by_q = per_root * (1 - q * per_root * per_root / 2);
    const Column relative = wave_->column(root * root);
    const double size = factor_ * half_wave();
    // dq/ds = q / (s S_0), since q is difference / rest_scale, and both depend linearly on s.
    return {size * rest_scale * relative.amplitude,
            size * (rest_scale * relative.slope * root_by_q * q_slope + rest_slope * relative.amplitude),
            size / scale * (relative.slope * root_by_q * q - (1 - rest_scale) * relative.amplitude)};
}

double ClosedForm::column_amplitude(double beta) const {
    return depth(beta, 1).amplitude;
}

ClosedForm::LocalShape ClosedForm::shape_at(const Cylindrical& rest) const {
    LocalShape at{1, 0, 0, 0, 0, false, rest.z};
    if (body_.shape) {
        at.scale = body_.shape->scale(rest.z);
        at.scale_slope = body_.shape->scale_slope(rest.z);
        at.arc_z -= alpha_ / body_.length * body_.shape->drift(rest.z);
    }
    const double radius = at.scale * body_.radius, weight = depth_weight(rest.rho, radius);
    at.inner = rest.rho < radius / 2;
    if (!wave_) return at;
    const auto [wave, slope] = wave_at(body_.shape.get(), body_.profile, body_.folds, body_.length, rest.z);
    at.wave = wave * weight;
    at.wave_slope = slope * weight - (at.inner ? at.wave * at.scale_slope / at.scale : 0);
    at.wave_per_rho = weight_per_rho(rest.rho, radius) * wave;
    return at;
}

glm::dvec3 ClosedForm::position(const Cylindrical& rest) const {
    return position(rest, depth(rest.beta, scale(rest.z)));
}

glm::dvec3 ClosedForm::normal(const Cylindrical& rest, const CylindricalVector& rest_normal) const {
    return normal(rest, rest_normal, depth(rest.beta, scale(rest.z)));
}

glm::dvec3 ClosedForm::tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent) const {
    return tangent(rest, rest_tangent, depth(rest.beta, scale(rest.z)));
}

glm::dvec3 ClosedForm::position(const Cylindrical& rest, const Depth& depth) const {
    const LocalShape shape = shape_at(rest);
    const double wrinkle = depth.amplitude * shape.wave;
    return Bend{body_.length, body_.radius, alpha_, theta_}.position({rest.beta, shape.arc_z, rest.rho},
                                                                     wrinkle);
}

ClosedForm::Local ClosedForm::local(const Cylindrical& rest, const Depth& depth) const {
    const LocalShape shape = shape_at(rest);
    const double c = std::cos(rest.beta - theta_), s = std::sin(rest.beta - theta_);
    const double curvature = alpha_ / body_.length;
    Local at{};
    at.frame = bent_frame(c, s, curvature * shape.arc_z);
    at.around = 1 + depth.amplitude * shape.wave_per_rho;
    at.outward = shape.inner ? at.around : 1;
    at.across = depth.by_beta * shape.wave_per_rho;
    at.along =
        depth.amplitude * shape.wave_slope + (depth.by_scale * shape.scale_slope + depth.by_z) * shape.wave;
    const double rho = rest.rho + depth.amplitude * shape.wave;
    at.stretch = ((1 - kappa_) - curvature * rho * c) * (1 - kappa_ * (shape.scale - 1));
    return at;
}

// Cofactors of the Jacobian: its inverse transpose times the determinant, without a division.
glm::dvec3 ClosedForm::normal(const Cylindrical& rest, const CylindricalVector& rest_normal,
                              const Depth& depth) const {
    const Local at = local(rest, depth);
    const glm::dvec3 bent{at.around * at.stretch * rest_normal.rho,
                          at.stretch * (at.outward * rest_normal.beta - at.across * rest_normal.rho),
                          at.around * (at.outward * rest_normal.z - at.along * rest_normal.rho)};
    return unit(turned(at.frame * bent, theta_));
}

glm::dvec3 ClosedForm::tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent,
                               const Depth& depth) const {
    const Local at = local(rest, depth);
    const glm::dvec3 bent{
        at.outward * rest_tangent.rho + at.across * rest_tangent.beta + at.along * rest_tangent.z,
        at.around * rest_tangent.beta, at.stretch * rest_tangent.z};
    return unit(turned(at.frame * bent, theta_));
}

glm::dvec3 ClosedForm::center(double z) const {
    if (body_.shape) z -= alpha_ / body_.length * body_.shape->drift(z);
    return Bend{body_.length, body_.radius, alpha_, theta_}.position({0, z, 0}, 0);
}

CylindricalVector straightened_normal(const glm::dvec3& vector, const Cylindrical& at, double length,
                                      double radius, const Pose& rest, const Shape* shape) {
    const BareBend bend(at, length, radius, rest, shape);
    return components(unit(glm::transpose(bend.frame) * vector * glm::dvec3(1, 1, bend.stretch)));
}

CylindricalVector straightened_tangent(const glm::dvec3& vector, const Cylindrical& at, double length,
                                       double radius, const Pose& rest, const Shape* shape) {
    const BareBend bend(at, length, radius, rest, shape);
    // Not divided by the stretch, which may be near 0: the direction is what counts.
    return components(unit(glm::transpose(bend.frame) * vector * glm::dvec3(bend.stretch, bend.stretch, 1)));
}

double depth_weight(double rho, double radius) {
    return std::min(1.0, 2 * rho / radius);
}

double shape_slope_z(Profile profile, FoldRange folds, double length, double z) {
    const double x = folds.place(z / length);
    // Only `damped` has a crease to blend; the slopes of the others are odd in x as they are.
    const double side = profile.kind == Profile::Kind::damped ? std::clamp(x / crease_width, -1.0, 1.0)
                                                              : std::copysign(1.0, x);
    return side * shape_slope(profile, folds.total, std::min(std::abs(x), 1.0)) * 2 /
           folds.wave_length(length);
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
