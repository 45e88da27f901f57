// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// Binds a mesh to its base cylinder: the offline step that makes a body (may allocate, may throw).

namespace goffer::fit {

/// How the depth of wrinkles is chosen: none, as the paper has it (paper), such that the base cylinder keeps
/// its area exactly (area), or such that the bound mesh does (mesh).
using Amplitude = paper::Amplitude;

/// The shape of wrinkles along the body: deepest at mid-length as the paper has it, with creases there and at
/// the ends (damped), or without creases (smooth).
using Profile = paper::Profile;

/// A stretch of the body that bends along an arc of its own.
struct RegionOptions {
    double share = 1;  ///< of the body's length, > 0; the shares of all regions add up to 1 (within 1e-6)
    std::optional<int> folds;  ///< as BindOptions::folds, of this region
};

/// What can be chosen at bind. The defaults suit a mesh that nobody has looked at.
struct BindOptions {
    /// Folds k per half length of a region, 0..max_folds. Unset: sensible_folds() of each region. More than
    /// the mesh carries is allowed.
    std::optional<int> folds;
    Amplitude amplitude = Amplitude::paper;
    Profile profile = Profile::damped;
    int table_rows = default_table_rows;  ///< 2..4096
    /// From base to tip, at most bend::max_regions; none: the body is one region. Their lengths and folds are
    /// fixed at bind; each has an angle and a direction of its own in a pose.
    std::vector<RegionOptions> regions;
    /// q0, 0..1: squeezes far below it make no wrinkle, so that wrinkles begin gently; columns
    /// become shorter by up to about q0 of their length for it. Unset: 0, and gentle_onset for a body that is
    /// bent at rest, where without it the wrinkle would begin with a step.
    /// See modules/paper/README.md, "Onset".
    std::optional<double> onset;

    static constexpr int max_folds = 64;
    static constexpr int default_table_rows = 256;
    static constexpr double gentle_onset = 1e-3;
};

/// Throws Error, which begins with "regions: ", if a body cannot be cut into `regions`: more than
/// bend::max_regions, a share that is not above 0, shares that do not add up to 1. Thread-safe.
void check(std::span<const RegionOptions> regions);

/// The regions that `options` ask for: one of all the length where none are named; those without folds of
/// their own get BindOptions::folds. Thread-safe.
[[nodiscard]] std::vector<RegionOptions> regions_of(const BindOptions& options);

/// What was found of a region.
struct RegionBinding {
    double length = 0;       ///< of its outer line, model units
    int folds = 0;           ///< k in use; 0: no wrinkle
    int folds_capacity = 0;  ///< most folds that the mesh has vertices for
};

/// A body, and what was found on the way. It is a rig, too: bind_level() puts other meshes on it.
struct Binding {
    bend::Body body;
    std::vector<RegionBinding> regions;  ///< as many as the body's
    /// Vertex i of the body, and so of every output stream, is vertex order[i] of the geometry: regions'
    /// vertices follow each other. Empty where the order is the geometry's, as it is for one region.
    std::vector<std::uint32_t> order;
    Cylinder cylinder;  ///< the base that it was bound to
    Profile profile = Profile::damped;
    double milliseconds = 0;  ///< time that bind took

    [[nodiscard]] int folds(std::size_t region = 0) const { return regions[region].folds; }
    [[nodiscard]] int folds_capacity(std::size_t region = 0) const { return regions[region].folds_capacity; }
};

/// Makes the body of `geometry` on `cylinder`, straight or bent at rest. Vertices go to the region that they
/// stand in, in the order that they have in the geometry (Binding::order). Normals and tangents are carried
/// where the geometry has them; normals are made (make_normals) where it doesn't. Vectors of no length are
/// replaced (normals by made ones, tangents by a direction orthogonal to the normal).
///
/// Throws Error: what check(geometry) and check(cylinder) throw; an option out of range; a vertex of a
/// triangle below z = 0 or above z = length by more than a thousandth of it; numbers outside
/// bend::WorkingRange; Amplitude::area for a body bent at rest or with an onset (use Amplitude::mesh). A
/// vertex that no triangle uses is bound at the nearer end where it lies beyond. Thread-safe. About 1 ms per
/// 10,000 vertices and 10 ms for each region's table; Amplitude::mesh deforms the mesh some hundred times, on
/// all processors: a tenth of a second for 10,000 vertices.
[[nodiscard]] Binding bind(const Geometry& geometry, const Cylinder& cylinder,
                           const BindOptions& options = {});

/// Binds another mesh of the same model to the rig of `rig`: a level of detail, a layer of clothes.
/// The new body shares with it the cylinder, the regions with their lengths, folds, rest arcs and onsets, the
/// tables of wrinkles and factors, and the largest angles. One array of poses serves both, and vertices whose
/// positions at rest are equal, bit for bit, are deformed to positions that are equal, bit for bit: where a
/// level keeps vertices of the finer mesh, they don't move when levels change.
///
/// The level's own are its vertices, their normals and tangents (carried or made as bind() does) and, in the
/// result, RegionBinding::folds_capacity and Binding::order. `level` is in the model space of the mesh that
/// the rig was bound from. Bind the finest level with bind(), where folds are chosen and Amplitude::mesh is
/// solved, and the others to it: a coarser one gets the finer one's wrinkles as far as its rows can show
/// them, and keeps its area as well as it resembles the finer one.
///
/// Vertices of its triangles may lie off the finer mesh, as a simplifier leaves them, but not beyond the base
/// cylinder's ends by more than a thousandth of its length. The largest angles are not taken back for a
/// vertex that lies farther from the axis than all of the rig's: at these angles such a vertex may fold
/// through the body. `rig` is not needed afterward, and may itself be a level.
///
/// Throws Error: what check(level) throws; an empty rig; a vertex beyond the ends; numbers outside
/// bend::WorkingRange. Thread-safe. About 1 ms per 10,000 vertices.
[[nodiscard]] Binding bind_level(const Geometry& level, const Binding& rig);

/// The wrinkle table for a base cylinder: `rows` rows from angle 0 to `max_angle` (radians, > 0), made in
/// double from eq 7's solution at Chebyshev points; kernels that interpolate 256 of them stay within 5e-6 L
/// of the closed form. (Not so for Amplitude::area with one or two folds of Profile::smooth: that factor has
/// a corner at a fraction of a degree, which the points round off, by some 1e-4 L.) Empty for folds = 0 or
/// Amplitude::none. Thread-safe. Throws Error on a length, radius, angle, folds or rows out of range.
[[nodiscard]] bend::WrinkleTable make_wrinkle_table(Profile profile, Amplitude amplitude, int folds,
                                                    double length, double radius, double max_angle,
                                                    int rows = BindOptions::default_table_rows);

/// The largest usable |angle| (radians): just below where L / alpha - r = rho_max + A(alpha), that is where
/// the outermost vertex, lifted by the wrinkle, would reach the arc's center and the body fold through
/// itself. `rho_max`: largest distance of a vertex from the axis; `factor`: on the amplitude, beside that of
/// Amplitude::area. See modules/paper/README.md, "Limits". Thread-safe; errors as above.
[[nodiscard]] double largest_angle(Profile profile, Amplitude amplitude, int folds, double length,
                                   double radius, double rho_max, double factor = 1);

}  // namespace goffer::fit
