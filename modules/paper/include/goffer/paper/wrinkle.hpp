// SPDX-License-Identifier: MIT
#pragma once

/// The wrinkle of a squeezed vertex column, in double: the oscillation (eq 6), the compression of a column
/// (eq 9, 10), and the amplitude that keeps the column's length (eq 7).
///
/// Chen, Fang, Yang, Li, Chen. "Local Deformation Method for Soft Cylindrical Model". Journal of System
/// Simulation 27(6), 2015, 1255-1261. Equation numbers are that paper's.
/// modules/paper/README.md, "Wrinkle" puts it together.
///
/// Angles are radians, lengths model units. Every function here is pure and may be called from any thread.

namespace goffer::paper {

/// Shape of the wrinkle along the body, as a function of u = |2 z / L - 1|: 0 at mid-height, 1 at both ends.
enum class Profile {
    damped,  ///< g(u) = (1 - u) cos(2 pi k u), the paper's. Creases at mid-height and at the ends.
    smooth,  ///< g(u) = (1 - u^2)^2 cos(2 pi k u). No crease anywhere.
};

/// How the amplitude is chosen.
enum class Amplitude {
    none,   ///< no wrinkle: the bare bend
    paper,  ///< eq 7: every column keeps its length on the flat strip
    area,   ///< eq 7 times m(alpha): the lateral area of the bent, wrinkled base is 2 pi r L
    mesh,   ///< eq 7 times m(alpha, theta), solved on a mesh's own triangles at bind; here, where
            ///< there is no mesh, as `paper`
};

/// Wrinkle shape g(u), u in 0..1, for `folds` k >= 1 oscillations per half length.
[[nodiscard]] double shape(Profile profile, int folds, double u);

/// dg/du at u in 0..1; one-sided where g has a crease (u = 0 and u = 1 of `damped`).
[[nodiscard]] double shape_slope(Profile profile, int folds, double u);

/// Squeeze q = 1 - S = kappa (1 + cos(beta - theta)) of the column at `beta` (eq 9, 10; kappa = alpha r / L).
[[nodiscard]] double squeeze(double kappa, double beta, double theta);

/// Solves eq 7 for the relative amplitude a: the integral over u in 0..1 of sqrt(1 + a^2 g'(u)^2) is
/// 1 / (1 - q). `squeeze` q in 0 <= q < 1; folds >= 1. Returns a >= 0, within 1e-12 relative.
/// Throws std::invalid_argument outside that range.
[[nodiscard]] double relative_amplitude(Profile profile, int folds, double squeeze);

/// Amplitude A = (L / 2) S a of a column (eq 7), in the units of `length`. Same domain and errors.
[[nodiscard]] double amplitude(Profile profile, int folds, double length, double squeeze);

/// Lateral area of the bent, wrinkled base cylinder as a fraction of 2 pi r L, by quadrature of the exact
/// Jacobian of the map (no grid). `angle` alpha in radians (0 <= alpha < length / (2 radius)); `factor`
/// multiplies the amplitude of eq 7. factor = 0 is the bare bend, whose value is exactly 1 - kappa.
[[nodiscard]] double lateral_area(Profile profile, int folds, double length, double radius, double angle,
                                  double factor);

/// The factor m(alpha) that makes `lateral_area` one (amplitude mode `area`), at most 1.5. The area is met
/// within 1e-7 up to six tenths of the largest angle and 2e-6 up to all of it, as long as the wrinkle is
/// lower than the radius. At alpha = 0 the limit of `damped` is returned, N and G being the integrals of g^2
/// and g'^2 over u in 0..1:
///
///     m = 1 / sqrt(1 + (L / r)^2 N / (16 G))
///
/// and the same for `smooth`, which has no such limit: its mean displacement is not zero (-24 / (2 pi k)^4 of
/// the amplitude), costs area like sqrt(alpha), and drives m to 1.5 below some small angle (at L / r = 10:
/// half a degree for k = 1, 1e-5 degrees for k = 3). Throws std::invalid_argument for an alpha out of range.
[[nodiscard]] double area_factor(Profile profile, int folds, double length, double radius, double angle);

}  // namespace goffer::paper
