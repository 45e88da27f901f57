// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

/// Fits the base cylinder of a mesh: axis, base and tip, length, radius, and the arc of a body that is bent
/// in its file. Offline: functions may allocate and throw.

namespace goffer::fit {

/// A stretch of a center line at rest: one arc.
struct RestArc {
    double length;     ///< of its outer line, model units, > 0
    double angle;      ///< radians, >= 0
    double direction;  ///< toward which it bends, radians, where its cross-sections are carried without twist
};

/// The base cylinder of a body, in model space and model units. A plain value.
struct Cylinder {
    glm::dvec3 origin{0};       ///< center of the base end, where z = 0
    glm::dvec3 axis{0, 0, 1};   ///< e3, unit length, from base to tip (at the base end of an arc)
    glm::dvec3 zero{1, 0, 0};   ///< e1, unit length, orthogonal to `axis`: the zero of beta
    double length = 1;          ///< L > 0, of the outer line of an arc
    double radius = 0.1;        ///< r > 0
    double rest_angle = 0;      ///< alpha_0 of the center line at rest, radians; 0 for a straight body
    double rest_direction = 0;  ///< theta_0 of the center line at rest, radians
    double residual = 0;        ///< area-weighted rms of (rho - r) / r over the lateral surface: how far the
                                ///< mesh is from the cylinder. For information
    /// Radii of a body that is thicker here than there, model units: control values of paper::Spline at equal
    /// steps from base to tip, whose mean is `radius`, and all of them below length / (2 rest_angle). Empty:
    /// a cylinder.
    std::vector<double> radii = {};
    /// The center line at rest of a body that no single arc follows, from base to tip: each arc begins where
    /// and as the one before ends. Their lengths add up to `length`. rest_angle is then 0, and bind() makes a
    /// region of each. Empty: one arc, or a straight line.
    std::vector<RestArc> arcs = {};

    /// Whether the center line at rest is an arc, or a chain, be it of straight arcs.
    [[nodiscard]] bool bent() const { return rest_angle != 0 || !arcs.empty(); }
};

/// What fit_cylinder may take for a body's shape at rest.
enum class RestPose {
    automatic,  ///< an arc where one fits clearly better than a straight line
    straight,   ///< a straight line, whatever the body
    chain       ///< as automatic, or a chain of arcs where that fits clearly better
};

/// The most arcs that a chain is fitted of. One that turns by more than half a turn is then cut in two, so
/// that a chain may have more.
inline constexpr std::size_t max_arcs = 12;

/// An Error of fit_cylinder() that another axis mends, or one at all where none is given.
class AxisError : public Error {
public:
    using Error::Error;
};

/// Fits a base cylinder to a triangle mesh.
///
/// `axis` is the direction from base to tip, of any length; nothing: the mesh's long axis is found, and
/// signed so that its largest component is positive. `zero` of the result is the world axis that is most
/// nearly orthogonal to its `axis` (x before y before z where they tie), made orthogonal.
///
/// With RestPose::automatic the center line may be an arc: rest_angle is then below 2 pi and below length /
/// (2 radius), rest_direction (-pi..pi) is where it bends toward, and `residual` is measured about the arc.
/// The direction from base to tip is that of the arc's chord, which is found; an `axis` that is given decides
/// which end is the base. An arc is taken if its sections are circles about it within 0.3 of the radius, or
/// 0.2 beyond a half turn, and within 0.8 of what they are about the best straight line (rms of rho within
/// slices, so that a taper does not count); if its residual times its radius is smaller too, or the former
/// are within 0.5; if its sagitta is more than 0.05 of the radius; if the body is a tube that was bent along
/// it (as much surface on the inner side as on the outer one, within 3.5 and 7 % of the area, and no more
/// than a thousandth of it across the gap between the ends); and if a given `axis` is within about 45 degrees
/// of its chord. Otherwise the result is that of RestPose::straight, and rest_angle is exactly 0.
///
/// With RestPose::chain, a body that is rougher than 0.08 of the radius about that arc or line, or much
/// slenderer than its sections about it, may get a chain of 2 to max_arcs (more where one would turn by more
/// than half a turn), and its body as many regions: if its sections lie all around the chain; if all of it
/// lies between the chain's ends; if it is a tube that was bent along it; and if a given `axis` is within
/// about 45 degrees of its chord, which is signed as the long axis is otherwise. Its sections must be circles
/// about the chain within 0.1 of the radius and within 0.45 of what they are about the line, and its middle a
/// quarter of the radius from the line somewhere; or, where it is rougher than 0.12 and its middle more than
/// the radius from the line, within 0.2 and 0.7 or within 0.25 and 0.5. A mesh without a long axis may get
/// one, too. How many arcs follow a body best may change with a small change of its mesh.
///
/// `arcs`, 2..bend::max_regions, says how many with RestPose::chain: the result is then a chain of so many,
/// whatever else would be better, if the body is a tube or not. Where fewer follow the body, and more do not
/// do so clearly better, the longest ones are halved. 0: as above.
///
/// The result does not depend on how densely parts are tessellated, on duplicated vertices, or on whether the
/// ends are closed; it follows rotation, translation and uniform scale of the mesh.
///
/// Throws Error as check(geometry) does, and if an axis is zero or not finite, no triangle has an area,
/// `arcs` is given without RestPose::chain or is outside 2..bend::max_regions, or the body does not follow a
/// chain of `arcs` (and names a number that it follows). Throws AxisError if no axis is given and the mesh
/// has no long one, nor a chain if it may have one; if it has no surface around the axis or no extent along
/// it; or if the body is too thin for float at its coordinates. Thread-safe.
[[nodiscard]] Cylinder fit_cylinder(const Geometry& geometry, std::optional<glm::dvec3> axis = std::nullopt,
                                    RestPose rest = RestPose::automatic, std::size_t arcs = 0);

/// Returns `cylinder` with the radii that the mesh has along it, and with their mean as its radius: the
/// area-weighted mean distance from the axis, smoothed over half a radius, at least a fifth of the mean. The
/// length of an arc changes with the radius, its center line does not. Returns `cylinder` without radii if
/// their rms deviation is below a twentieth of the mean, if there is no surface along it, or if the thickest
/// part is too thick for the rest arc. bind() does this by itself unless its options say otherwise.
///
/// Throws Error as check(geometry) and check(cylinder) do. Thread-safe. See modules/paper/README.md, "Shaped
/// bodies".
[[nodiscard]] Cylinder fit_shape(const Geometry& geometry, const Cylinder& cylinder);

/// Throws Error naming the field if `cylinder` cannot be used as a base: a number is not finite, length,
/// radius or one of the radii is not within 1e-40..1e40, the origin is farther than 1e40 on an axis,
/// rest_angle is negative or not below both 2 pi and length / (2 radius), axis and zero are not of unit
/// length or not orthogonal, within 1e-3, or the radii are fewer than two, do not have the radius as their
/// mean, within 1e-3, have one below a thousandth of it, or one that leaves the rest_angle no room, as the
/// radius does. Likewise if an angle of the arcs is not so with the largest radius along it, one is shorter
/// than 1e-5 of the length, there are more than bend::max_regions, their lengths do not add up to that of the
/// cylinder, within 1e-6, or rest_angle is not 0 beside them. Thread-safe.
void check(const Cylinder& cylinder);

/// Throws Error if no mesh can be bound to `cylinder`, since its origin or radius is outside
/// bend::WorkingRange, or its length beyond it: as bind() does, before there is work for each vertex.
/// Thread-safe.
void check_bindable(const Cylinder& cylinder);

/// Returns the radius of the arc that the center line is bent along at rest, infinite for a straight one and
/// for a chain; model units. `cylinder` must pass check(). Thread-safe.
[[nodiscard]] inline double rest_radius(const Cylinder& cylinder) {
    if (cylinder.rest_angle == 0) return std::numeric_limits<double>::infinity();
    return cylinder.length / cylinder.rest_angle - cylinder.radius;
}

/// Returns z of each position (model space): its height along the axis, or along the rest arc where there is
/// one; model units. `cylinder` must pass check(). Thread-safe.
[[nodiscard]] std::vector<double> heights(std::span<const glm::vec3> positions, const Cylinder& cylinder);

/// A point of a base: its direction about the center line, radians, its height as heights() has it, and its
/// distance from the center line, model units.
struct BasePoint {
    double beta, z, rho;
};

/// Returns where points of the base at rest are in model space. `cylinder` must pass check(). Thread-safe.
[[nodiscard]] std::vector<glm::dvec3> places_on_base(const Cylinder& cylinder,
                                                     std::span<const BasePoint> points);

/// Returns the most folds per half length that the mesh has vertices for. A fold needs 8 rows of vertices
/// along z, so an edge may reach over at most L / (16 k), within a thousandth. What counts is how far each
/// triangle reaches along z; the coarsest 2 % of the area are left out, so that one sliver does not decide.
/// 0: too coarse for any fold. Both arguments must pass check(). Thread-safe.
[[nodiscard]] int folds_capacity(const Geometry& geometry, const Cylinder& cylinder);

/// Returns the number of folds of Profile::damped or smooth to use when none is asked for: k = round(L / (2 r
/// fold_length)), which makes folds about `fold_length` radii long (unset: 1), or `capacity` if that is less.
/// Returns 0 if `capacity` is less than half of k, since so few folds would be so deep that they reach past
/// the axis. Thread-safe.
[[nodiscard]] int sensible_folds(const Cylinder& cylinder, int capacity,
                                 std::optional<double> fold_length = {});

}  // namespace goffer::fit
