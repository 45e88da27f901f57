// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/shape.hpp>
#include <goffer/paper/wave.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <glm/vec3.hpp>

#include <memory>

/// The deformation as a closed-form map, in double and without a grid: the bend (eq 2-5), the wrinkle (eq
/// 6-10), and the exact Jacobian, which carries normals and tangents. The float kernels are tested against
/// it. See modules/paper/README.md, "Bend", and "Errata of the paper".
///
/// The body frame has its origin at the center of the base end; e3 points along the axis from base to tip, e1
/// is the zero of beta, e2 = e3 x e1. Angles are radians, lengths model units. All functions are thread-safe.

namespace goffer::paper {

/// A vertex in cylinder coordinates.
struct Cylindrical {
    double beta = 0;  ///< direction about the axis, radians from e1 toward e2
    double z = 0;     ///< height along the axis, 0..L on the body
    double rho = 0;   ///< distance from the axis
};

/// The components of a vector along (e_rho, e_beta, e_z) at a vertex.
struct CylindricalVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

/// The base cylinder of one region and its wrinkle: what is fixed at bind.
struct Parameters {
    double length = 1;    ///< L, of the outer line, which a bend never shortens
    double radius = 0.1;  ///< r
    FoldRange folds = 0;  ///< k; 0: no wrinkle
    Profile profile = Profile::damped;
    Amplitude amplitude = Amplitude::paper;
    double rest_angle = 0;      ///< alpha_0 >= 0 of the arc that the body is bent along at rest
    double rest_direction = 0;  ///< theta_0 of that arc
    double onset = 0;           ///< q0 >= 0: the amplitude is that of q^2 / (q + q0)
    /// How the region differs from a cylinder; null: not at all. Its radius() must be `radius`, and it
    /// must have been made for `length`, which is not checked.
    std::shared_ptr<const Shape> shape = nullptr;
};

/// What changes per frame. A negative angle alpha stands for (|alpha|, theta + pi).
struct Pose {
    double angle = 0;
    double direction = 0;  ///< theta, toward which the body bends
};

/// The amplitude A of the wrinkle at one place, model units, and its derivatives.
struct Depth {
    double amplitude = 0;
    double by_beta = 0;
    double by_scale = 0;  ///< by s, the radius there over that of the region
    double by_z = 0;      ///< beside what s changes: where wrinkles of two regions pass into each other
};

/// The map of one body in one pose. The constructor solves what depends on the pose alone. Immutable.
class ClosedForm {
public:
    /// Throws std::invalid_argument if length or radius is not a finite number above 0; folds, rest_angle or
    /// onset is negative; the folds do not lie in their wave, or have a roundness outside 0..0.5; |angle| or
    /// rest_angle is not below length / (2 radius); a direction is not finite; the amplitude is `area` and
    /// the body is bent at rest, has an onset or a shape, or its wave runs on, for which no factor is known;
    /// a wave that runs on is not of Profile::even; or the shape has another radius, or is too thick for an
    /// angle, where it is thickest.
    ClosedForm(const Parameters& body, const Pose& pose);

    /// Returns the deformed position in the body frame (eq 2-6). Nothing is divided by alpha: at alpha = 0
    /// the result is the rest position, to the last bit. For a body that is bent at rest, `rest` is the
    /// vertex straightened (to_cylindrical).
    [[nodiscard]] glm::dvec3 position(const Cylindrical& rest) const;

    /// Returns the deformed unit normal in the body frame: the inverse transpose of the Jacobian times the
    /// rest normal. For a body that is bent at rest, `rest_normal` is straightened (straightened_normal).
    /// Within `crease_width` of a crease of the wrinkle the slopes of both sides are blended linearly, so
    /// that a vertex on the crease carries their mean. A zero vector stays one.
    [[nodiscard]] glm::dvec3 normal(const Cylindrical& rest, const CylindricalVector& rest_normal) const;

    /// Returns the deformed unit tangent in the body frame: the Jacobian times the rest tangent, which is
    /// straightened and blended as normal() says.
    [[nodiscard]] glm::dvec3 tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent) const;

    /// Return the same where the wrinkle is as deep as `depth` says.
    [[nodiscard]] glm::dvec3 position(const Cylindrical& rest, const Depth& depth) const;
    [[nodiscard]] glm::dvec3 normal(const Cylindrical& rest, const CylindricalVector& rest_normal,
                                    const Depth& depth) const;
    [[nodiscard]] glm::dvec3 tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent,
                                     const Depth& depth) const;

    /// Returns how deep the column at `beta` wrinkles in a part whose radius is `scale` times the region's.
    /// With the factor m(alpha).
    [[nodiscard]] Depth depth(double beta, double scale) const;

    /// Returns the radius at height `z` over that of the region.
    [[nodiscard]] double scale(double z) const { return body_.shape ? body_.shape->scale(z) : 1; }

    /// Returns the amplitude A of the column at `beta`, with the factor m(alpha); model units. For a body
    /// with a shape it is that of a part with the mean radius.
    [[nodiscard]] double column_amplitude(double beta) const;

    /// Returns the bent position of the center line at height `z`, in the body frame. The wrinkle has no part
    /// in it.
    [[nodiscard]] glm::dvec3 center(double z) const;

private:
    struct Local;       // what normal and tangent share at one vertex
    struct LocalShape;  // of the body, at a height
    [[nodiscard]] Local local(const Cylindrical& rest, const Depth& depth) const;
    [[nodiscard]] LocalShape shape_at(const Cylindrical& rest) const;
    [[nodiscard]] Depth relative_depth(double beta, double scale) const;  // with a rest arc, or an onset
    [[nodiscard]] double half_wave() const { return body_.folds.wave_length(body_.length) / 2; }

    Parameters body_;
    double alpha_ = 0;
    double theta_ = 0;
    double kappa_ = 0;
    double factor_ = 0;                 // m(alpha), or 0 without a wrinkle
    std::shared_ptr<const Wave> wave_;  // null without a wrinkle
};

/// Straighten a normal or a tangent of a body that is bent by `rest` at rest. `vector`: in the body frame of
/// the bent body. `at`: its vertex, straightened. The results have unit length. Both undo what normal() and
/// tangent() do without a wrinkle: a normal goes by the transpose of the bend's Jacobian, a tangent by its
/// inverse. Throw std::invalid_argument if length or radius is not a finite number above 0, |angle| is not
/// below length / (2 radius), or the direction is not finite. `shape`: of the body; null: a cylinder.
[[nodiscard]] CylindricalVector straightened_normal(const glm::dvec3& vector, const Cylindrical& at,
                                                    double length, double radius, const Pose& rest,
                                                    const Shape* shape = nullptr);
[[nodiscard]] CylindricalVector straightened_tangent(const glm::dvec3& vector, const Cylindrical& at,
                                                     double length, double radius, const Pose& rest,
                                                     const Shape* shape = nullptr);

/// Half-width of the blend at the creases. Across the outer line, where the amplitude has a corner, the sign
/// of h = cos((beta - theta) / 2) is replaced by clamp(h / crease_width, -1, 1): the blend reaches 0.11
/// degrees to either side. At mid-height the sign of x = 2 z / L - 1 is replaced by clamp(x / crease_width,
/// -1, 1): the blend reaches a thousandth of the half length.
inline constexpr double crease_width = 1e-3;

/// Returns the depth weight w(rho) = min(1, 2 rho / r), with which the wrinkle fades toward the axis, so that
/// inner parts do not cross it. rho >= 0, radius > 0.
[[nodiscard]] double depth_weight(double rho, double radius);

/// Returns dg/dz, the slope of the wrinkle's shape at height `z` (0..length), blended at mid-height as
/// `crease_width` says.
[[nodiscard]] double shape_slope_z(Profile profile, FoldRange folds, double length, double z);

/// Converts a point of the body frame to cylinder coordinates, and back. beta is within -pi..pi, 0 on the
/// axis.
[[nodiscard]] Cylindrical to_cylindrical(const glm::dvec3& point);
[[nodiscard]] glm::dvec3 from_cylindrical(const Cylindrical& point);

/// Returns the straightened cylinder coordinates of a point of a body that is bent by `rest` at rest: the
/// inverse of the bend (eq 2-5), without a wrinkle. If the body has a shape, replace z by
/// Shape::unshifted(z, |rest.angle| / length). `point` is in the body frame of the bent body, whose e3 is the
/// tangent of the center line at the base end.
///
/// Beyond the ends the arc goes on, as it does for ClosedForm: z < 0 and z > L come back from there. The gap
/// between tip and base is divided in its middle: one half lies beyond the tip, the other before the base.
/// beta is within -pi..pi, 0 on the axis. Nothing cancels at small angles: at angle 0 the result is
/// to_cylindrical(point), to the last bit.
///
/// Throws std::invalid_argument if length or radius is not a finite number above 0, the direction is not
/// finite, or |angle| is not below both length / (2 radius) and 2 pi, where one place would have two heights.
[[nodiscard]] Cylindrical to_cylindrical(const glm::dvec3& point, double length, double radius,
                                         const Pose& rest);

}  // namespace goffer::paper
