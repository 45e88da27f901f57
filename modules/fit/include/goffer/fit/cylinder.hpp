// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/geometry.hpp>

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <vector>

/// Fits the base cylinder: axis, base and tip, length, radius (offline; may allocate, may throw).

namespace goffer::fit {

/// The base cylinder of a body, in model space and model units. A plain value.
struct Cylinder {
    glm::dvec3 origin{0};       ///< center of the base end: z = 0
    glm::dvec3 axis{0, 0, 1};   ///< e3, unit, from base to tip
    glm::dvec3 zero{1, 0, 0};   ///< e1, unit, orthogonal to axis: the zero of beta
    double length = 1;          ///< L > 0
    double radius = 0.1;        ///< r > 0
    double rest_angle = 0;      ///< alpha_0 (rad) of the center line at rest; 0 for a straight body
    double rest_direction = 0;  ///< theta_0 (rad)
    double residual = 0;        ///< area-weighted rms of (rho - r) / r over the lateral surface
};

/// What may be taken for a body's shape at rest.
enum class Rest {
    automatic,  ///< an arc where that fits clearly better than a straight line
    straight    ///< a straight line, whatever the body
};

/// Fits a base cylinder to any triangle mesh.
///
/// `axis`: the direction from base to tip (any length, any sign is kept), or nothing to find the mesh's long
/// axis. A found axis is signed so that its largest component is positive. `zero` is the world axis (the one
/// most nearly orthogonal to `axis`; x before y before z) made orthogonal to `axis`.
///
/// With Rest::automatic the center line may be an arc. `rest_angle` is then that of the arc, below 2 pi and
/// below length / (2 radius), and `rest_direction` (-pi..pi) is where it bends to at the base; `axis` is the
/// tangent at the base end, `length` that of the outer line, and `residual` is measured about the arc.
/// A vertex's coordinates are paper::to_cylindrical's. An `axis` that is given then means the general
/// direction from base to tip, that of the arc's chord: the chord is found, and signed like it.
/// The arc is taken where its sections are circles about it within a fifth of the radius, and within four
/// fifths of what they are about the best straight line (rms of rho within slices, so that taper does not
/// count), where its sagitta is more than a twentieth of the radius, and where a given axis is within 45
/// degrees of its chord. Otherwise the result is that of Rest::straight, with rest_angle exactly 0.
///
/// The result does not depend on how densely parts are tessellated, on duplicated vertices, nor on whether
/// the ends are open or closed; it follows rotation, translation and uniform scale of the mesh. Throws Error:
/// what `check` throws; a mesh without a long axis when none is given (says how to give one); an axis that is
/// zero, not finite, or along which the mesh has no extent; a body thinner than float can carry. Pure; may be
/// called from any thread.
[[nodiscard]] Cylinder fit_cylinder(const Geometry& geometry, std::optional<glm::dvec3> axis = std::nullopt,
                                    Rest rest = Rest::automatic);

/// Throws Error naming the field if `cylinder` cannot be used as a base: a number not finite, length or
/// radius not positive, rest_angle negative or not below 2 pi and length / (2 radius), axis or zero not of
/// unit length (1e-3) or not orthogonal (1e-3).
void check(const Cylinder& cylinder);

/// A stretch of `cylinder` as a cylinder of its own: `length` long, and else the same. Thread-safe.
[[nodiscard]] inline Cylinder stretch_of(Cylinder cylinder, double length) {
    cylinder.length = length;
    return cylinder;
}

/// z of each position (model space): its height along the axis, or along the rest arc where there is one.
/// `cylinder` as `check` accepts it. Pure; may be called from any thread.
[[nodiscard]] std::vector<double> heights(std::span<const glm::vec3> positions, const Cylinder& cylinder);

/// The most folds per half length that the mesh can carry: a fold needs 8 rows of vertices along z, so an
/// edge may reach over at most L / (16 k). Decided by the triangles' extents in z, by area, the
/// coarsest 2 % left out, so that it does not turn on one sliver. 0: too coarse for any wrinkle. Both
/// arguments as `check` accepts them. Pure; may be called from any thread.
[[nodiscard]] int folds_capacity(const Geometry& geometry, const Cylinder& cylinder);

/// The number of folds to use when nobody says: folds about as long as the radius, k = round(L / (2 r)), at
/// most what the mesh can carry; none where it can carry less than half of that, since fewer and so deeper
/// folds would reach past the axis. At least 0. Pure; may be called from any thread.
[[nodiscard]] int sensible_folds(const Cylinder& cylinder, int capacity);

}  // namespace goffer::fit
