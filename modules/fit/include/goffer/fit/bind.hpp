// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <optional>

/// Binds a mesh to its base cylinder: the offline step that makes a body (may allocate, may throw).

namespace goffer::fit {

/// What can be chosen at bind. The defaults suit a mesh that nobody has looked at.
struct BindOptions {
    /// Folds k per half length, 0..max_folds. Unset: sensible_folds(). More than the mesh carries is allowed.
    std::optional<int> folds;
    paper::Amplitude amplitude = paper::Amplitude::paper;
    paper::Profile profile = paper::Profile::damped;
    int table_rows = default_table_rows;  ///< 2..4096

    static constexpr int max_folds = 64;
    static constexpr int default_table_rows = 256;
};

/// A body, and what was found on the way.
struct Bound {
    bend::Body body;
    int folds = 0;            ///< k in use; 0: no wrinkle
    int folds_capacity = 0;   ///< most folds that the mesh has vertices for
    double milliseconds = 0;  ///< time that bind took
};

/// Makes the body of `geometry` on `cylinder`. Vertex i of the body is vertex i of the geometry. Normals and
/// tangents are carried where the geometry has them; normals are made (make_normals) where it doesn't.
/// Vectors of no length are replaced (normals by made ones, tangents by a direction orthogonal
/// to the normal).
///
/// Throws Error: what check(geometry) and check(cylinder) throw; an option out of range; a vertex of a
/// triangle below z = 0 or above z = length by more than a thousandth of it; a cylinder bent at rest. A
/// vertex that no triangle uses is bound at the nearer end where it lies beyond. Thread-safe. About 1 ms per
/// 10,000 vertices and 10 ms for the table.
[[nodiscard]] Bound bind(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options = {});

/// The wrinkle table for a base cylinder: `rows` rows from angle 0 to `max_angle` (radians, > 0), made in
/// double from eq 7's solution at Chebyshev points; kernels that interpolate 256 of them stay within 5e-6 L
/// of the closed form. (Not so for Amplitude::area with one or two folds of Profile::smooth: that factor has
/// a corner at a fraction of a degree, which the points round off, by some 1e-4 L.) Empty for folds = 0 or
/// Amplitude::none. Thread-safe. Throws Error on a length, radius, angle, folds or rows out of range.
[[nodiscard]] bend::WrinkleTable make_wrinkle_table(paper::Profile profile, paper::Amplitude amplitude,
                                                    int folds, double length, double radius, double max_angle,
                                                    int rows = BindOptions::default_table_rows);

/// The largest usable |angle| (radians): just below where L / alpha - r = rho_max + A(alpha), that is where
/// the outermost vertex, lifted by the wrinkle, would reach the arc's centre and the body fold through
/// itself. `rho_max`: largest distance of a vertex from the axis. Thread-safe; errors as above.
[[nodiscard]] double largest_angle(paper::Profile profile, paper::Amplitude amplitude, int folds,
                                   double length, double radius, double rho_max);

}  // namespace goffer::fit
