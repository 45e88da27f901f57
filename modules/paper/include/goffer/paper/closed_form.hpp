// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wave.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <glm/vec3.hpp>

#include <memory>

/// The deformation as a closed-form map, in double and without a grid: bend (eq 2-5), wrinkle (eq 6-10), and
/// the analytic Jacobian that carries normals and tangents. The float32 kernels are tested against it.
/// See modules/paper/README.md, "Bend".
///
/// Body frame: origin at the center of the base end, e3 along the axis from base to tip, e1 the zero of
/// beta, e2 = e3 x e1. Angles are radians. Every function is pure and may be called from any thread.
///
/// Chen et al. 2015 (see wrinkle.hpp). Errata used: eq 5's dist is -x sin(theta) + y cos(theta), signed; eq
/// 2's R0 lies at distance L / alpha - r from the center line, so that the outer column keeps its length.

namespace goffer::paper {

/// A vertex in cylinder coordinates: direction about the axis (rad), height 0..L, distance from the axis.
struct Cylindrical {
    double beta = 0;
    double z = 0;
    double rho = 0;
};

/// A vector's components along (e_rho, e_beta, e_z) at a vertex.
struct CylindricalVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

/// The base cylinder and its wrinkle: what is fixed at bind.
struct Parameters {
    double length = 1;    ///< L, of the outer (never compressed) line
    double radius = 0.1;  ///< r
    int folds = 0;        ///< k; 0: no wrinkle
    Profile profile = Profile::damped;
    Amplitude amplitude = Amplitude::paper;
    double rest_angle = 0;      ///< alpha_0 >= 0 of the arc that it is bent along at rest
    double rest_direction = 0;  ///< theta_0
    double onset = 0;           ///< q0: the amplitude is that of q^2 / (q + q0)
};

/// One instance's state. angle alpha < 0 means (|alpha|, theta + pi).
struct Pose {
    double angle = 0;
    double direction = 0;
};

/// The map for one pose of one body. Construction solves what depends on the pose alone (m(alpha)).
class ClosedForm {
public:
    /// Throws std::invalid_argument where length or radius is not positive or |angle| >= length / (2 radius),
    /// rest_angle likewise; where onset is negative; and for Amplitude::area of a body that is bent at rest
    /// or has an onset, for which no factor is known.
    ClosedForm(const Parameters& body, const Pose& pose);

    /// Deformed position in the body frame (eq 2-6). No division by alpha: at 0 exactly the rest position. Of
    /// a body that is bent at rest, `rest` is where the vertex would be if straightened (to_cylindrical).
    [[nodiscard]] glm::dvec3 position(const Cylindrical& rest) const;

    /// Deformed unit normal in the body frame, from the normal at rest (of a body that is bent at rest:
    /// straightened, see straightened_normal): inverse transpose of the Jacobian times the rest normal, the
    /// depth weight's derivative included. Within `crease_width` of a crease of the wrinkle the one-sided
    /// derivatives are blended linearly, so that a vertex on a crease carries the mean of both sides.
    [[nodiscard]] glm::dvec3 normal(const Cylindrical& rest, const CylindricalVector& rest_normal) const;

    /// Deformed tangent in the body frame: the Jacobian times the rest tangent, to unit length. Blends too.
    [[nodiscard]] glm::dvec3 tangent(const Cylindrical& rest, const CylindricalVector& rest_tangent) const;

    /// Amplitude A of the column at beta, m(alpha) included; model units.
    [[nodiscard]] double column_amplitude(double beta) const;

    /// Bent position of the center line at height z, and the frame carried along it: columns (n, b, t) with n
    /// toward theta, t along the center line, in the body frame.
    [[nodiscard]] glm::dvec3 center(double z) const;

private:
    struct Local;  // what position, normal and tangent share at one vertex
    [[nodiscard]] Local local(const Cylindrical& rest) const;
    [[nodiscard]] Column column(double beta) const;           // A and dA/dbeta, model units
    [[nodiscard]] Column relative_column(double beta) const;  // of a body with a rest arc, or an onset
    [[nodiscard]] double wrinkle(const Cylindrical& rest) const;

    Parameters body_;
    double alpha_ = 0;
    double theta_ = 0;
    double kappa_ = 0;
    double factor_ = 0;                 // m(alpha), or 0 without a wrinkle
    std::shared_ptr<const Wave> wave_;  // null without a wrinkle
};

/// A rest normal's components, straightened: by the transpose of the Jacobian of the bend `rest` of a body of
/// `length` and `radius`; to unit length. `vector`: in the bent body's frame. `at`: the vertex, straightened.
/// straightened_tangent: by the Jacobian's inverse. Both undo what normal() and tangent() do without a
/// wrinkle. Errors as to_cylindrical.
[[nodiscard]] CylindricalVector straightened_normal(const glm::dvec3& vector, const Cylindrical& at,
                                                    double length, double radius, const Pose& rest);
[[nodiscard]] CylindricalVector straightened_tangent(const glm::dvec3& vector, const Cylindrical& at,
                                                     double length, double radius, const Pose& rest);

/// Half-width of the blend at the creases. Across the outer line (where the amplitude has a corner) the sign
/// of h = cos((beta - theta) / 2) is replaced by clamp(h / crease_width, -1, 1); at mid-height the sign of x
/// = 2 z / L - 1 by clamp(x / crease_width, -1, 1). About 0.1 degrees, and a thousandth of the half length.
inline constexpr double crease_width = 1e-3;

/// Depth weight w(rho) = min(1, 2 rho / r): the wrinkle fades toward the axis, so that inner parts keep
/// their side.
[[nodiscard]] double depth_weight(double rho, double radius);

/// Wrinkle shape with sign of slope along z: dg/dz at height z, blended at mid-height as `crease_width` says.
[[nodiscard]] double shape_slope_z(Profile profile, int folds, double length, double z);

/// Cylinder coordinates of a point of the body frame, and back. beta is 0 on the axis.
[[nodiscard]] Cylindrical to_cylindrical(const glm::dvec3& point);
[[nodiscard]] glm::dvec3 from_cylindrical(const Cylindrical& point);

/// Cylinder coordinates of a point of a body of `length` L and `radius` r that is bent at rest: the inverse
/// of the bend (eq 2-5) in `rest`, without a wrinkle. The point is in the body frame of the bent body: origin
/// at the center of the base end, e3 the center line's tangent there.
///
/// Beyond the ends the arc goes on, as it does for ClosedForm: z < 0 and z > L come back from there. The
/// whole circle is shared out so that the gap between tip and base is cut in its middle. beta is 0 on the
/// axis, else within -pi..pi. Nothing cancels at small angles: at 0 it is exactly to_cylindrical(point).
/// Throws std::invalid_argument where length or radius is not positive, or where |angle| is not below length
/// / (2 radius) and below 2 pi, beyond which one place is that of two heights.
[[nodiscard]] Cylindrical to_cylindrical(const glm::dvec3& point, double length, double radius,
                                         const Pose& rest);

}  // namespace goffer::paper
