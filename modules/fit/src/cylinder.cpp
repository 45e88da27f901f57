// SPDX-License-Identifier: MIT
#include "arc.hpp"
#include "bent_tube.hpp"
#include "chain.hpp"
#include "rest.hpp"
#include "sections.hpp"
#include "surface.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/body_input.hpp>
#include <goffer/bend/region.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/paper/shape.hpp>

#include <glm/geometric.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

namespace goffer::fit {
namespace {

/// A body is long where its surface spreads (in standard deviations) this much farther along one direction
/// than along the next: an open cylinder of L = 3 r does by 1.22, a sphere, a cube and a disc by 1.00.
constexpr double long_enough = 1.1;

/// Least squares can tell the axis of a body that is a cylinder but for a relief. Others keep their principal
/// axis. This is the largest residual of the former.
constexpr double nearly_round = 0.1;

/// The long axis, signed so that its largest component is positive.
Vector3d long_axis(const Principal& principal) {
    if (principal.distinct < long_enough) {
        throw AxisError("the mesh has no long axis: it is about as wide as it is long (its surface spreads " +
                        text(principal.distinct) + " to 1, and " + text(long_enough) +
                        " is needed); give an axis");
    }
    return principal.axis;
}

Vector3d given_axis(const glm::dvec3& axis) {
    const Vector3d direction = eigen(axis);
    if (!direction.allFinite() || direction.isZero(0)) {
        throw Error("axis " + text(direction) + " has no direction; give three finite numbers, not all 0");
    }
    return direction.stableNormalized();
}

/// Settles the line, but keeps the start where that fails, or leads as far away as the center of a shallow
/// trough's circle is.
Line settled_near(const Body& body, const Line& start, bool tilt) {
    constexpr double far = 0.8;  // of the circle's radius: an arc of less than 130 degrees
    const Settled settled = settle(body, start, tilt);
    const bool within = (settled.line.point - start.point).norm() < far * settled.radius;  // false for NaN
    return within ? settled.line : start;
}

/// Tilts a long axis where the body is so round that this makes it more exact.
Line straighten(const Body& body, const Line& start) {
    constexpr double hopeless = 3 * nearly_round;  // tilting is not worth its time
    if (section(body, start).residual > hopeless) return start;
    const Line tilted = settled_near(body, start, true);
    return section(body, tilted).residual < nearly_round ? tilted : start;
}

/// The fit with base and tip exchanged if `axis` asks for it. Without an axis, the largest component of the
/// direction from base to tip is made positive.
Fitted toward(const std::optional<glm::dvec3>& axis, const Fitted& fitted) {
    const Vector3d chord = moved_along(fitted.line, (fitted.low + fitted.high) / 2).axis();
    const double along = axis ? chord.dot(given_axis(*axis)) : chord[first_largest(chord.cwiseAbs())];
    if (!(along < 0)) return fitted;
    const Line& line = fitted.line;
    return {line_through(line.point, -line.axis(), line.bow), -fitted.high, -fitted.low, fitted.section};
}

/// The arc, if there is one and its chord has about the direction of `axis`.
std::optional<Fitted> arc_instead(const Body& body, const Principal& principal, const Line& straight,
                                  const std::optional<glm::dvec3>& axis) {
    const bool round_about = principal.distinct < long_enough;
    std::optional<Fitted> arc =
        fit_arc(body, axis && round_about ? given_axis(*axis) : principal.axis, straight);
    if (!arc || !axis) return arc;
    const Vector3d chord = moved_along(arc->line, (arc->low + arc->high) / 2).axis();
    return lies_along(chord, given_axis(*axis)) ? arc : std::nullopt;
}

/// Whether the arc explains the mesh better than the straight line: one radius does, or sections do by far,
/// as those of a banana, whose ends are thin.
bool explains(const Body& body, const Fitted& arc, const Fitted& straight) {
    constexpr double by_far = 0.5;
    const auto residual = [](const Fitted& fit) { return fit.section.residual * fit.section.radius; };
    const auto rough = [&](const Fitted& fit) { return roughness(body, View(body, fit.line)); };
    return residual(arc) < residual(straight) || rough(arc) < by_far * rough(straight);
}

/// The fit as a cylinder in model space.
Cylinder cylinder_of(const Body& body, const Fitted& fitted) {
    const Line base = moved_along(fitted.line, fitted.low);
    const double angle = fitted.angle();
    Cylinder cylinder;
    cylinder.origin = from_eigen(body.middle + body.size * base.point);
    cylinder.axis = from_eigen(base.axis());
    cylinder.zero = from_eigen(base.frame.col(0));
    cylinder.length = body.size * (fitted.high - fitted.low + angle * fitted.section.radius);
    cylinder.radius = body.size * fitted.section.radius;
    cylinder.residual = fitted.section.residual;
    if (angle == 0) return cylinder;
    cylinder.rest_angle = angle;
    cylinder.rest_direction = std::atan2(base.bow.dot(base.frame.col(1)), base.bow.dot(base.frame.col(0)));
    return cylinder;
}

/// Float at these coordinates has to tell the axis from the skin, and base from tip.
void check_size(const Cylinder& cylinder, const Body& body) {
    using Float = std::numeric_limits<float>;
    const double reach = body.middle.cwiseAbs().maxCoeff() + body.size;
    const double least = std::max<double>(4 * double{Float::epsilon()} * reach, Float::min());
    const bool thin = cylinder.radius < least;
    if (!thin && cylinder.length >= least) return;
    throw AxisError("the mesh's " + std::string(thin ? "radius " : "length ") +
                    text(thin ? cylinder.radius : cylinder.length) + " about the axis " +
                    text(eigen(cylinder.axis)) + " is too small for floats at coordinates up to " +
                    text(reach) + "; move the mesh to the origin, scale it up or give another axis");
}

void check_unit(const glm::dvec3& v, std::string_view name) {
    constexpr double tolerance = 1e-3;
    if (std::abs(glm::length(v) - 1) <= tolerance) return;
    throw Error("cylinder: " + std::string(name) + " " + text(eigen(v)) +
                " is not of length 1; normalize it");
}

void check_finite(const Vector3d& value, std::string_view name) {
    if (value.allFinite()) return;
    throw Error("cylinder: " + std::string(name) + " " + text(value) + " is not finite; give finite numbers");
}

void check_positive(double value, std::string_view name) {
    if (std::isfinite(value) && value > 0) return;
    throw Error("cylinder: " + std::string(name) + " is " + text(value) + "; give a finite number above 0");
}

/// Meshes of floats have no others; and no product of these on the way to a body leaves double's range.
constexpr double least_size = 1e-40, largest_size = 1e40;

void check_size(double value, std::string_view name) {
    check_positive(value, name);
    if (value >= least_size && value <= largest_size) return;
    throw Error("cylinder: " + std::string(name) + " is " + text(value) +
                ", beyond what a mesh of floats can have; give a number within " + text(least_size) + ".." +
                text(largest_size));
}

/// The inner line of the arc must have a length, and the arc must not come around to where it began.
void check_rest_angle(const Cylinder& cylinder) {
    const double most = std::min(2 * std::numbers::pi, cylinder.length / (2 * cylinder.radius));
    if (cylinder.rest_angle >= 0 && cylinder.rest_angle < most) return;
    throw Error("cylinder: rest_angle " + text(cylinder.rest_angle) + " is outside 0.." + text(most) +
                ", the range for this length and radius; give radians within it");
}

void check_radii(const Cylinder& cylinder) {
    if (cylinder.radii.empty()) return;
    constexpr double least = 1e-3;  // of the mean
    for (const double radius : cylinder.radii) {
        check_size(radius, "one of the radii");
        if (radius < least * cylinder.radius)
            throw Error("cylinder: one of the radii is " + text(radius) + ", and radius is " +
                        text(cylinder.radius) + "; give a thousandth of it at least");
    }
    const std::size_t count = cylinder.radii.size();
    if (count < 2) throw Error("cylinder: radii has one value; give two or more, or none");
    const double mean = paper::Spline(cylinder.length, cylinder.radii).mean();
    if (!(std::abs(mean / cylinder.radius - 1) <= 1e-3)) {
        throw Error("cylinder: radii have the mean " + text(mean) + ", and radius is " +
                    text(cylinder.radius) + "; make them the same");
    }
    const double thickest = *std::ranges::max_element(cylinder.radii);
    if (cylinder.rest_angle < cylinder.length / (2 * thickest)) return;
    throw Error("cylinder: radii of " + text(thickest) + " are too thick for the rest_angle of " +
                text(cylinder.rest_angle) +
                ", which has room for less than length / (2 rest_angle); give a " +
                "smaller angle, or no radii");
}

/// Asks of each arc of a chain what check_rest_angle() and check_radii() ask of a single one.
void check_arcs(const Cylinder& cylinder) {
    if (cylinder.arcs.empty()) return;
    if (cylinder.rest_angle != 0)
        throw Error("cylinder: both rest_angle and arcs are given; give one of them");
    if (cylinder.arcs.size() > bend::max_regions)
        throw Error("cylinder: " + std::to_string(cylinder.arcs.size()) + " arcs are more than the " +
                    std::to_string(bend::max_regions) + " regions that a body may have");
    double sum = 0;
    for (const RestArc& arc : cylinder.arcs) {
        check_size(arc.length, "the length of one of the arcs");
        check_finite(Vector3d(arc.angle, arc.direction, 0), "one of the arcs");
        constexpr double least = 1e-5;  // of the body
        if (!(arc.length >= least * cylinder.length))
            throw Error("cylinder: one of the arcs is " + text(arc.length) +
                        " long, too short for a region of a body of " + text(cylinder.length) +
                        "; leave it out");
        sum += arc.length;
    }
    if (!(std::abs(sum / cylinder.length - 1) <= 1e-6))
        throw Error("cylinder: the lengths of its arcs add up to " + text(sum) + ", and length is " +
                    text(cylinder.length) + "; make them the same");
    double start = 0;
    for (const RestArc& arc : cylinder.arcs) {
        const double thickest = thickest_of(cylinder, start, arc.length);
        const double most = std::min(2 * std::numbers::pi, arc.length / (2 * thickest));
        if (!(arc.angle >= 0 && arc.angle < most))
            throw Error("cylinder: the angle of one of the arcs, " + text(arc.angle) + ", is outside 0.." +
                        text(most) +
                        ", the range for its length and its largest radius; give radians within it");
        start += arc.length;
    }
}

void check_count(std::size_t arcs, RestPose rest) {
    if (arcs == 0) return;
    if (rest != RestPose::chain) throw Error("arcs: are for RestPose::chain; give none, or that");
    if (arcs < 2 || arcs > bend::max_regions)
        throw Error("arcs: " + std::to_string(arcs) + " is outside 2.." + std::to_string(bend::max_regions));
}

Cylinder chain_of(const Body& body, std::size_t arcs, const std::optional<Vector3d>& axis) {
    const std::optional<Cylinder> chain = fit_chain_of(body, arcs, axis);
    if (!chain || chain->arcs.size() > arcs) {
        throw Error("arcs: the body does not follow a chain of " + std::to_string(arcs) +
                    (axis ? " along that axis" : "") +
                    (chain ? ", but of " + std::to_string(chain->arcs.size()) + "; give that, or none"
                           : ", nor of more; give none") +
                    " to have a straight body or one arc");
    }
    check_size(*chain, body);
    return *chain;
}

}  // namespace

Cylinder fit_cylinder(const Geometry& geometry, std::optional<glm::dvec3> axis, RestPose rest,
                      std::size_t arcs) {
    check(geometry);
    check_count(arcs, rest);
    const Body body = body_of(geometry);
    const std::optional<Vector3d> given = axis ? std::optional(given_axis(*axis)) : std::nullopt;
    const Principal principal = principal_axis(body);  // refuses a body without area
    if (arcs > 0) return chain_of(body, arcs, given);
    const auto chain_instead = [&](const Line& line) -> std::optional<Cylinder> {
        if (rest != RestPose::chain) return std::nullopt;
        return fit_chain(body, line, given);
    };
    if (!axis && principal.distinct < long_enough) {  // it may be long all the same, if it is bent
        if (const auto chain = chain_instead(line_through(principal.centroid, principal.axis))) {
            check_size(*chain, body);
            return *chain;
        }
    }
    const Vector3d direction = given ? *given : long_axis(principal);
    const Line line = settled_near(body, line_through(principal.centroid, direction), false);
    const bool kept = axis && rest == RestPose::straight;
    const Line best = kept ? line : straighten(body, line);
    std::optional<Fitted> found;
    if (rest != RestPose::straight) found = arc_instead(body, principal, best, axis);
    const Fitted straight = measured(body, axis ? line : best);
    if (found && !(explains(body, *found, straight) && is_bent_tube(body, cylinder_of(body, *found))))
        found.reset();
    if (!found) found = straight;
    const std::optional<Cylinder> chain = chain_instead(found->line);
    Cylinder cylinder = chain ? *chain : cylinder_of(body, toward(axis, *found));
    check_size(cylinder, body);
    return cylinder;
}

void check(const Cylinder& cylinder) {
    check_finite(eigen(cylinder.origin), "origin");
    if (eigen(cylinder.origin).cwiseAbs().maxCoeff() > largest_size) {
        throw Error("cylinder: origin " + text(eigen(cylinder.origin)) +
                    " is beyond what a mesh of floats can have; move it to the mesh");
    }
    check_finite(eigen(cylinder.axis), "axis");
    check_finite(eigen(cylinder.zero), "zero");
    check_size(cylinder.length, "length");
    check_size(cylinder.radius, "radius");
    check_finite(Vector3d::Constant(cylinder.rest_angle), "rest_angle");
    check_finite(Vector3d::Constant(cylinder.rest_direction), "rest_direction");
    check_finite(Vector3d::Constant(cylinder.residual), "residual");
    check_rest_angle(cylinder);
    check_radii(cylinder);
    check_arcs(cylinder);
    check_unit(cylinder.axis, "axis");
    check_unit(cylinder.zero, "zero");
    constexpr double tolerance = 1e-3;
    if (std::abs(glm::dot(cylinder.axis, cylinder.zero)) > tolerance) {
        throw Error("cylinder: zero " + text(eigen(cylinder.zero)) + " is not orthogonal to axis " +
                    text(eigen(cylinder.axis)) + "; subtract its part along the axis");
    }
}

void check_bindable(const Cylinder& cylinder) {
    using Range = bend::WorkingRange;
    const auto require = [](bool within, bend::BodyField field) {
        if (within) return;
        throw Error(std::string("cannot bind: ") +
                    bend::describe(bend::BodyFault{field, bend::Reason::out_of_range}).c_str() +
                    "; scale or move the model");
    };
    require(eigen(cylinder.origin).cwiseAbs().maxCoeff() <= Range::max_origin, bend::BodyField::origin);
    require(cylinder.radius >= Range::min_length && cylinder.radius <= Range::max_length,
            bend::BodyField::radius);
    require(cylinder.length <= Range::max_length, bend::BodyField::length);
}

}  // namespace goffer::fit
