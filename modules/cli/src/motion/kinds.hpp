// SPDX-License-Identifier: MIT
#pragma once

#include "motion/curve.hpp"
#include "motion/motion.hpp"
#include "motion/path.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// The kinds of motion that there are.

namespace goffer::cli {

/// How far regions bend, and which way.
struct RegionAngles {
    /// Degrees: one per region, or one that regions share by their lengths. An infinity: as far as a region
    /// can.
    std::vector<double> angles;
    std::vector<std::optional<double>> directions;  ///< degrees, one per region, where they are said
};

/// What `said` says of a region of `body`: its angle, degrees, no infinity.
[[nodiscard]] double angle_of(const RegionAngles& said, const bend::Body& body, std::size_t region);

/// The same of all regions: one angle for each.
[[nodiscard]] RegionAngles on_body(const RegionAngles& said, const bend::Body& body);

/// The poses that `goffer bend --angles` has for these, one per region. From the rest pose of a chain, what a
/// region has no room for is lost, where `goffer bend --by` gives it to others: which these are would change
/// from one frame to the next.
[[nodiscard]] std::vector<bend::Pose> poses_for(const bend::Body& body, const RegionAngles& angles,
                                                bool from_rest);

/// Poses at given times.
struct KeyedAngles {
    std::vector<double> times;  ///< seconds, ascending, two or more
    std::vector<RegionAngles> keys;
    Interpolation interpolation = Interpolation::smooth;
    bool repeats = false;    ///< the last key is as the first
    bool from_rest = false;  ///< angles count from the rest pose
};
[[nodiscard]] std::unique_ptr<const Motion> make_motion(KeyedAngles keys);

/// Paths at given times, on which the body lies: the same words, but for where their points are.
struct KeyedPaths {
    std::vector<double> times;
    std::vector<PathWords> keys;
    Interpolation interpolation = Interpolation::smooth;
    bool repeats = false;
    std::string where;  ///< begins errors
};
[[nodiscard]] std::unique_ptr<const Motion> make_motion(KeyedPaths keys);

/// There and back, sinusoidally.
struct Swing {
    RegionAngles from, to;  ///< with the same directions
    double seconds = 1;     ///< there and back
    double lag = 0;         ///< swings; a region is behind by the share of it that lies below the region
    bool from_rest = false;
};
[[nodiscard]] std::unique_ptr<const Motion> make_motion(Swing swing);

/// A body that walks along a path, from where its base is at the beginning to where its tip is at the end, or
/// once around.
struct Walk {
    Path path;
    double seconds = 1;
    Interpolation interpolation = Interpolation::linear;  ///< smooth: it sets out and arrives gently
};
[[nodiscard]] std::unique_ptr<const Motion> make_motion(Walk walk);

}  // namespace goffer::cli
