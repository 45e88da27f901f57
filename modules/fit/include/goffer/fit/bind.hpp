// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/bind_options.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/shape.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

/// Binds a mesh to its base cylinder, which makes a body. Offline: functions may allocate and throw.

namespace goffer::fit {

/// What bind found out about a region.
struct RegionBinding {
    double length = 0;  ///< of the region's outer line, model units
    int folds = 0;      ///< k in use; 0: no wrinkle
    /// Most folds that the mesh has vertices for. After bind() with Profile::even: at least `folds`, unless a
    /// number was asked for; with a wrinkle_range, those within it, and as many as there are beyond it, where
    /// the surface is smooth.
    int folds_capacity = 0;
    /// How its radius and its folds change along it; null: not at all.
    std::shared_ptr<const paper::Shape> shape = {};
    /// Its folds as a part of the wave that they belong to, which may run on over joints.
    paper::FoldRange wave = {};
    double blend = 0;  ///< bend::RegionInput::blend
};

/// Returns the triangles that may wrinkle, 3 vertices each, in the order of the geometry's: those whose
/// centroids lie in `range` and whose corners follow half of their wrinkle or more, on average, by
/// Geometry::wrinkle_mask. What lies beyond an end of the body counts as at that end. Throws Error as
/// check(geometry) and check(cylinder) do, and where BindOptions::wrinkle_range would be refused.
/// Thread-safe.
[[nodiscard]] std::vector<std::uint32_t> triangles_within(const Geometry& geometry, const Cylinder& cylinder,
                                                          const WrinkleRange& range);

class Parts;

/// A body, and what was found on the way to it. bind_level() binds other meshes to the same cylinder, regions
/// and tables: this is then their rig.
struct Binding {
    bend::Body body;
    std::vector<RegionBinding> regions;  ///< one for each of the body's regions
    /// Vertex i of the body, and so of every output stream, is vertex order[i] of the geometry: the vertices
    /// of a region follow those of the one before. Empty where the order is the geometry's, as with one
    /// region.
    std::vector<std::uint32_t> order;
    Cylinder cylinder;  ///< the base that the mesh was bound to, with its radii
    Profile profile = Profile::damped;
    Amplitude amplitude = Amplitude::paper;
    /// What thin parts bear of their wrinkles, for bind_level() and sockets; null: all of it everywhere.
    std::shared_ptr<const Parts> parts = {};
    double milliseconds = 0;  ///< what bind or bind_level took, by the wall clock

    /// `region` must be in range.
    [[nodiscard]] int folds(std::size_t region = 0) const { return regions[region].folds; }
    [[nodiscard]] int folds_capacity(std::size_t region = 0) const { return regions[region].folds_capacity; }

    /// Returns the body's vertex for each vertex of the geometry, the inverse of `order`: an index buffer of
    /// the geometry becomes one of the body where each index i is replaced by the i-th of these. Throws Error
    /// if `order` is not what bind() set. Thread-safe.
    [[nodiscard]] std::vector<std::uint32_t> vertices_in_body() const;
};

/// Makes a body of `geometry` on `cylinder`, straight or bent at rest. A vertex belongs to the region that it
/// stands in; within a region those near joints that folds run over come first and last, and all else keeps
/// the order that it has in the geometry (Binding::order). Normals and tangents are taken from the geometry,
/// at unit length. Normals that it does not have, or that have no length, are made (make_normals); a tangent
/// without length becomes a direction orthogonal to the normal. A vertex that no triangle uses is bound at
/// the nearer end where it lies beyond one, and 1000 radii from the axis where it is farther away; on a chain
/// of arcs, any vertex that lies beyond an end by more than 5e-4 of the length of the arc there is bound so
/// far beyond it. At rest these are not where they were.
///
/// Throws Error as check(geometry) and check(cylinder) do, and if an option is out of range, a vertex of a
/// triangle lies beyond an end by more than a thousandth of the length, a number is outside
/// bend::WorkingRange, regions are given beside a cylinder's arcs, but not one for each, or Amplitude::area
/// is asked for a body that is bent at rest or has an onset or a wrinkle_range (use Amplitude::mesh).
///
/// Takes time for each vertex and, independently of these, for each region's table. Amplitude::mesh deforms
/// each vertex some 500 times, in parallel in the caller's oneTBB arena; all else runs on the calling thread.
/// Thread-safe.
[[nodiscard]] Binding bind(const Geometry& geometry, const Cylinder& cylinder,
                           const BindOptions& options = {});

/// Binds another mesh of the same model to the base of `rig`: a level of detail, or a layer of clothes. The
/// new body has the rig's cylinder, regions (lengths, folds, rest arcs, onsets), tables of wrinkles and of
/// factors, and largest angles. One array of poses serves both bodies, and vertices with the same position at
/// rest, bit for bit, go to the same position, bit for bit: a vertex that a level keeps of the finer mesh
/// does not move when levels change.
///
/// The vertices, normals and tangents are the level's own (taken or made as bind() does), and so are
/// RegionBinding::folds_capacity and Binding::order in the result. `level` is in the model space of the mesh
/// that the rig was bound from. Bind the finest level with bind(), which chooses the folds and solves
/// Amplitude::mesh, and the others to it: a coarser level shows the same wrinkles as far as its rows can, and
/// keeps its area as well as it resembles the finer one.
///
/// Vertices of triangles may lie off the finer mesh, as a simplifier leaves them, but not beyond an end of
/// the base cylinder by more than a thousandth of its length. A vertex that is farther from the axis than all
/// of the rig's does not lower the largest angles: near them it may fold through the body. `rig` may itself
/// be a level, and is not needed afterward.
///
/// Throws Error as check(level) and check(rig.cylinder) do, and if the rig's body is empty or does not have
/// the rig's regions, a vertex of a triangle lies beyond the ends, or a number is outside bend::WorkingRange.
/// Thread-safe.
[[nodiscard]] Binding bind_level(const Geometry& level, const Binding& rig);

/// Makes the wrinkle table of one region: `rows` rows (2..4096) from angle 0 to `max_angle` (radians), in
/// double, from solutions of eq 7 at Chebyshev points. Kernels that interpolate 256 rows stay within 5e-6 L
/// of the closed form, except for Amplitude::area with four folds or fewer: up to 1e-3 L with one fold of
/// Profile::smooth. `max_scale` >= 1: the largest radius over `radius`. Amplitude::mesh has the table of
/// Amplitude::paper; its factors are solved by bind(). Empty for folds = 0 or Amplitude::none.
///
/// Throws Error if length or radius is not a finite number above 0, folds is outside 0..max_folds (with
/// Profile::even 0..2 max_folds), the profile's roundness is outside 0..0.5, max_scale is not a finite number
/// of 1 or more, max_angle is not above 0 and below length / (2 radius max_scale), or `rows` is out of range.
/// Thread-safe. See modules/paper/README.md, "Wrinkle table".
[[nodiscard]] bend::WrinkleTable make_wrinkle_table(Profile profile, Amplitude amplitude,
                                                    paper::FoldRange folds, double length, double radius,
                                                    double max_angle,
                                                    int rows = BindOptions::default_table_rows,
                                                    double max_scale = 1);

/// Returns the largest usable |angle| of a region (radians): 0.999 times the one at which L / alpha - r =
/// rho_max + crest A(alpha), where the outermost vertex, lifted by the wrinkle, reaches the center of the arc
/// and the body begins to fold through itself (crest: the largest value of the wave, 1 but for
/// Profile::even); with Profile::even at most the one at which the most squeezed column keeps a tenth of its
/// length. `rho_max` is the largest distance of a vertex from the axis (counted as the radius if less);
/// `factor` >= 0 multiplies the amplitude, beside the factor of Amplitude::area.
///
/// Throws Error if length or radius is not a finite number above 0, folds is outside 0..max_folds (with
/// Profile::even 0..2 max_folds), the profile's roundness is outside 0..0.5, or rho_max is negative or not
/// finite. Thread-safe. See modules/paper/README.md, "Limits".
[[nodiscard]] double largest_angle(Profile profile, Amplitude amplitude, paper::FoldRange folds,
                                   double length, double radius, double rho_max, double factor = 1);

}  // namespace goffer::fit
