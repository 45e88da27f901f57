// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/wrinkle.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

/// What can be chosen where a mesh is bound: goffer/fit/bind.hpp.

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
    /// Of the body's length, > 0; all regions' shares add up to 1, within 1e-6. Has no effect where a
    /// cylinder has arcs, whose lengths are the regions'.
    double share = 1;
    std::optional<int> folds = {};  ///< as BindOptions::folds, for this region alone
};

/// What can be chosen at bind. The defaults suit a mesh that nobody has looked at.
struct BindOptions {
    /// Folds k of a region: per half length, 0..max_folds, or over the whole length with Profile::even,
    /// 0..2 max_folds; of a body that is bent at rest along a chain of arcs, those of all its regions. More
    /// than the mesh has vertices for are allowed. Unset: folds of fold_length. With Profile::even folds are
    /// longer where the mesh has fewer rows than 8 for one, or where the region is too long for so many. They
    /// fade where that makes them 1.5 to 2.5 radii long, or up to a radius longer than a fold_length
    /// above 1.5. With other profiles, sensible_folds() of each region, with a capacity of at most max_folds:
    /// with the default fold_length none where a region is longer than 2048 radii.
    std::optional<int> folds = {};
    /// Length of a fold, in radii of the body where it stands, 1e-40..1e40. Depth goes with it: half as long,
    /// half as deep. Has no effect where folds are given. Unset: default_fold_length(); with Profile::even a
    /// twelfth of the body's length where that is less, but an eighth of a radius at least.
    std::optional<double> fold_length = {};
    Amplitude amplitude = Amplitude::paper;
    Profile profile = Profile::even;
    /// With ShapeMode::automatic, a body without radii of its own gets those of fit_shape(). A body that
    /// is bent at rest along one arc and has several regions gets a cylinder in any case, and so does any
    /// with Amplitude::area. Thin parts beside the axis hardly sway, and none passes through another, with
    /// Profile::even and no `folds` or `fold_length` given. See modules/paper/README.md, "Shaped bodies" and
    /// "Parts beside the axis".
    ShapeMode shape = ShapeMode::automatic;
    /// Beyond it the surface stays smooth, for a face or a label. Folds are counted as if it were the whole
    /// body; at an end that is not the body's own they fade within a fold and half a radius.
    /// Amplitude::mesh keeps the area of what lies inside. What is not to be smooth all around the body is
    /// said by Geometry::wrinkle_mask, which takes nothing from the depth elsewhere, and adds nothing to it.
    WrinkleRange wrinkle_range = {};
    int table_rows = default_table_rows;  ///< rows of each region's wrinkle table, 2..WrinkleTable::max_rows
    /// From base to tip, at most bend::max_regions. Empty: the body is one region, or has one for each arc of
    /// its cylinder. For a cylinder with arcs: none, or one for each.
    std::vector<RegionOptions> regions = {};
    /// Folds of Profile::even run on over the joints of regions that wrinkle alike, and pass into each other
    /// within a quarter of a fold on both sides, where they would else fade out. Has no effect with other
    /// profiles, and with Amplitude::area. Vertices near such joints take about twice as long in a run. See
    /// modules/paper/README.md, "Folds over joints", for what alike means.
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

    static constexpr int max_folds = 512;
    static constexpr int default_table_rows = 256;
    static constexpr double gentle_onset = 1e-3;
};

/// Throws Error if a body cannot be cut into `regions`: they are more than bend::max_regions, a share is not
/// a finite number above 0, or the shares do not add up to 1. Thread-safe.
void check(std::span<const RegionOptions> regions);

/// Returns the default of BindOptions::fold_length: 0.5 for Profile::even (less on a stout body), else 1.
/// Thread-safe.
[[nodiscard]] double default_fold_length(Profile profile);

}  // namespace goffer::fit
