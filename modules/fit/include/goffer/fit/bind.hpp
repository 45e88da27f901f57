// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/shape.hpp>
#include <goffer/paper/wrinkle.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// Binds a mesh to its base cylinder, which makes a body. Offline: functions may allocate and throw.

namespace goffer::fit {

/// What decides the depth of wrinkles: nothing, there are none (none); every column of the base cylinder
/// keeps its length, as in the paper (paper); the base cylinder keeps its area exactly (area); or the bound
/// mesh keeps its area (mesh): as a whole, and with Profile::even slice by slice, as far as wrinkles of about
/// a quarter of the radius can, unless folds are given or a fold_length.
using Amplitude = paper::Amplitude;

/// The shape of wrinkles along the body. They are deepest at mid-length, and either have creases there and at
/// the ends, as in the paper (damped), or none (smooth); or they have one depth throughout, with round crests
/// and tight troughs (even).
using Profile = paper::Profile;

/// What is taken for the base of a body: its own radius at each height where that is not the same throughout,
/// and with default folds less of a wrinkle for thin parts beside the axis (automatic); or one radius, and
/// all of it (cylinder).
enum class ShapeMode { automatic, cylinder };

/// A stretch of the body that may wrinkle, as shares of its length from base to tip: 0 <= first < last <= 1.
struct WrinkleRange {
    double first = 0;
    double last = 1;

    [[nodiscard]] bool whole() const { return first == 0 && last == 1; }
};

/// What can be chosen for one region: a stretch of the body that bends along an arc of its own.
struct RegionOptions {
    double share = 1;  ///< of the body's length, > 0; all regions' shares add up to 1, within 1e-6
    std::optional<int> folds = {};  ///< as BindOptions::folds, for this region
};

/// What can be chosen at bind. The defaults suit a mesh that nobody has looked at.
struct BindOptions {
    /// Folds k of a region: per half length, 0..max_folds, or over the whole length with Profile::even,
    /// 0..2 max_folds. More than the mesh has vertices for are allowed. Unset: folds of fold_length. With
    /// Profile::even folds are longer where the mesh has fewer rows than 8 for one, or where the region is
    /// too long for so many. They fade where that makes them 1.5 to 2.5 radii long, or up to a radius longer
    /// than a fold_length above 1.5. Otherwise sensible_folds() of each region, with a capacity of at most
    /// max_folds: with the default fold_length none where a region is longer than 257 radii.
    std::optional<int> folds = {};
    /// Length of a fold, in radii of the body where it stands, 1e-40..1e40. Depth goes with it: half as long,
    /// half as deep. Has no effect where folds are given. Unset: default_fold_length().
    std::optional<double> fold_length = {};
    Amplitude amplitude = Amplitude::paper;
    Profile profile = Profile::even;
    /// With ShapeMode::automatic, a body without radii of its own gets those of fit_shape(). A body that
    /// is bent at rest and has several regions gets a cylinder in any case, and so does any with
    /// Amplitude::area. See modules/paper/README.md, "Shaped bodies" and "Parts beside the axis".
    ShapeMode shape = ShapeMode::automatic;
    /// Beyond it the surface stays smooth, for a face or a label. Folds are counted as if it were the whole
    /// body; at an end that is not the body's own they fade within a fold and half a radius.
    /// Amplitude::mesh keeps the area of what lies inside. What is not to be smooth all around the body is
    /// said by Geometry::wrinkle_mask, which takes nothing from the depth elsewhere, and adds nothing to it.
    WrinkleRange wrinkle_range = {};
    int table_rows = default_table_rows;  ///< rows of each region's wrinkle table, 2..WrinkleTable::max_rows
    /// From base to tip, at most bend::max_regions. Empty: the body is one region.
    std::vector<RegionOptions> regions = {};
    /// Folds of Profile::even run on over the joints of regions that both wrinkle, and pass into each other
    /// within a quarter of a fold on both sides, where they would else fade out; not where the folds of one
    /// are more than three times as long as those of the other. Has no effect with other profiles, and with
    /// Amplitude::area. See modules/paper/README.md, "Folds over joints".
    bool folds_over_joints = true;
    /// Onset q0, 0..1: squeezes far below it make no wrinkle, so that wrinkles begin gently. Columns become
    /// shorter by up to about q0 of their length for it. Unset: gentle_onset for a body that is bent at rest,
    /// whose wrinkles would begin with a step otherwise; 0 for a straight one.
    /// See modules/paper/README.md, "Onset".
    std::optional<double> onset = {};
    /// Called with the share of bind()'s time that has passed, 0..1, roughly, from any thread and from
    /// several at a time. Must not throw. Empty: nobody is told.
    std::function<void(double)> progress = {};

    /// Returns the options with which bodies bend as in the paper: Profile::damped, Amplitude::paper, one
    /// radius, no onset. A base that is bent at rest stays so: fit it with RestPose::straight.
    [[nodiscard]] static BindOptions as_in_paper();

    static constexpr int max_folds = 64;
    static constexpr int default_table_rows = 256;
    static constexpr double gentle_onset = 1e-3;
};

/// Throws Error, with a text that begins with "regions: ", if a body cannot be cut into `regions`: they are
/// more than bend::max_regions, a share is not a finite number above 0, or the shares do not add up to 1.
/// Thread-safe.
void check(std::span<const RegionOptions> regions);

/// Returns the regions that `options` ask for: one over the whole length if there are none. Those without
/// folds of their own get BindOptions::folds. Thread-safe.
[[nodiscard]] std::vector<RegionOptions> regions_of(const BindOptions& options);

/// What bind found out about a region.
struct RegionBinding {
    double length = 0;       ///< of the region's outer line, model units
    int folds = 0;           ///< k in use; 0: no wrinkle
    int folds_capacity = 0;  ///< most folds that the mesh has vertices for: after bind, where it wrinkles;
                             ///< after bind_level, in the whole region
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

/// Returns BindOptions::fold_length where nobody says: 0.5 for Profile::even, else 1.
[[nodiscard]] double default_fold_length(Profile profile);

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
};

/// Makes a body of `geometry` on `cylinder`, straight or bent at rest. A vertex belongs to the region that it
/// stands in; within a region those near joints that folds run over come first and last, and all else keeps
/// the order that it has in the geometry (Binding::order).
/// Normals and tangents are taken from the geometry, at unit length. Normals that it does not have, or that
/// have no length, are made (make_normals); a tangent without length becomes a direction orthogonal to the
/// normal. A vertex that no triangle uses and that lies beyond an end is bound at that end.
///
/// Throws Error as check(geometry) and check(cylinder) do, and if an option is out of range, a vertex of a
/// triangle lies beyond an end by more than a thousandth of the length, a number is outside
/// bend::WorkingRange, or Amplitude::area is asked for a body that is bent at rest or has an onset or a
/// wrinkle_range (use Amplitude::mesh).
///
/// Takes time for each vertex and, independently of these, for each region's table. Amplitude::mesh deforms
/// the mesh some 500 times for each region, in parallel in the caller's oneTBB arena; all else runs on the
/// calling thread. Thread-safe.
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
/// Throws Error as check(level) does, and if the rig's body is empty or does not have the rig's regions, a
/// vertex of a triangle lies beyond the ends, or a number is outside bend::WorkingRange. Thread-safe.
[[nodiscard]] Binding bind_level(const Geometry& level, const Binding& rig);

/// Makes the wrinkle table of one region: `rows` rows (2..4096) from angle 0 to `max_angle` (radians), in
/// double, from solutions of eq 7 at Chebyshev points. Kernels that interpolate 256 rows stay within 5e-6 L
/// of the closed form, except for Amplitude::area with four folds or fewer: up to 1e-3 L with one fold of
/// Profile::smooth. `max_scale` >= 1: the largest radius over `radius`. Amplitude::mesh has the table of
/// Amplitude::paper; its factors are solved by bind(). Empty for folds = 0 or Amplitude::none.
///
/// Throws Error if length or radius is not a finite number above 0, folds is outside 0..max_folds (with
/// Profile::even 0..2 max_folds), roundness is outside 0..0.5, max_scale is not a finite number of 1 or more,
/// max_angle is not above 0 and below length / (2 radius max_scale), or `rows` is out of range. Thread-safe.
/// See modules/paper/README.md, "Wrinkle table".
[[nodiscard]] bend::WrinkleTable make_wrinkle_table(Profile profile, Amplitude amplitude,
                                                    paper::FoldRange folds, double length, double radius,
                                                    double max_angle,
                                                    int rows = BindOptions::default_table_rows,
                                                    double max_scale = 1);

/// Returns the largest usable |angle| of a region (radians): 0.999 times the one at which L / alpha - r =
/// rho_max + A(alpha), where the outermost vertex, lifted by the wrinkle, reaches the center of the arc and
/// the body begins to fold through itself; with Profile::even at most the one at which the most squeezed
/// column keeps a tenth of its length. `rho_max` is the largest distance of a vertex from the axis (counted
/// as the radius if less); `factor` >= 0 multiplies the amplitude, beside the factor of Amplitude::area.
///
/// Throws Error if length or radius is not a finite number above 0, folds is outside 0..max_folds (with
/// Profile::even 0..2 max_folds), roundness is outside 0..0.5, or rho_max
/// is negative or not finite. Thread-safe. See modules/paper/README.md, "Limits".
[[nodiscard]] double largest_angle(Profile profile, Amplitude amplitude, paper::FoldRange folds,
                                   double length, double radius, double rho_max, double factor = 1);

}  // namespace goffer::fit
