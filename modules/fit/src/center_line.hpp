// SPDX-License-Identifier: MIT
#pragma once

#include "sections.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Center lines that no single arc follows, as the mesh shows them: points along the middle of the body, and
/// chains of arcs through these.

namespace goffer::fit {

/// A point in the middle of a body, in units of its size.
struct CenterPoint {
    Vector3d place;
    double along;   ///< length from the first one
    double weight;  ///< share of the surface about it
    double radius;  ///< of the body there
};

/// Sections along a body that have a center each: so many radii apart, as far as these are enough of them and
/// no more than that.
inline constexpr double center_step = 0.75, fewest_centers = 12, most_centers = 96;

/// Adds a point behind the others.
void append(std::vector<CenterPoint>& points, const Vector3d& place, double weight, double radius);

/// Points along the middle of a body, from one end to the other.
struct CenterPoints {
    std::vector<CenterPoint> points;
    double radius;  ///< of a tube of that length with the body's area
};

/// Returns points 0.75 radii apart, or 92 of them along a longer body; none if the body is too stout for
/// that. They are the centroids of what is equally far from both ends, measured along the surface, so that it
/// does not matter how far a body is bent.
[[nodiscard]] CenterPoints center_points(const Body& body);

/// An arc of a chain. `curvature`: toward its center, of length 1 / its radius, along e1 and e2 of the frame
/// that the base's becomes where it is carried along the chain without twist.
struct ChainArc {
    double length;
    Eigen::Vector2d curvature;
};

/// A chain of arcs, each of which begins where and as the one before ends. A place belongs to the arc that is
/// nearest; beyond their ends the first and the last one go on.
class ArcChain {
public:
    /// The columns of `frame` are e1, e2, e3 at `point`, where the first arc begins.
    ArcChain(const Vector3d& point, const Matrix3d& frame, std::span<const ChainArc> arcs);

    /// Maps a place to (x, y, z): what is left of it when the chain is straightened.
    [[nodiscard]] Vector3d straightened(const Vector3d& place) const;
    /// The inverse.
    [[nodiscard]] Vector3d bent(const Vector3d& at) const;

    /// The arc at a height. Beyond their ends it is the first and the last one.
    [[nodiscard]] std::size_t arc_at(double z) const;
    /// The frame at a height.
    [[nodiscard]] Line line_at(double z) const;

    [[nodiscard]] const std::vector<ChainArc>& arcs() const { return arcs_; }

private:
    struct Piece {
        double start;
        Line line;  // where the arc begins, with the carried frame
        Straightened about_middle;
    };

    std::vector<ChainArc> arcs_;
    std::vector<Piece> pieces_;  // one for each
};

/// Which chains may be fitted. An arc that has hardly an inner side, at the largest radius of its points, is
/// avoided, but the caller has to look.
struct ChainLimits {
    double radius;     ///< of the body, in the mean
    double shortest;   ///< no arc is shorter
    double tolerance;  ///< rms distance from the points, in their own radii: of fit_fewest_arcs()
};

/// Returns the chain of `count` arcs, 1 or more, that is near the points; nothing where so many have no room.
[[nodiscard]] std::optional<ArcChain> fit_arcs(std::span<const CenterPoint> points, const ChainLimits& limits,
                                               std::size_t count);

/// Returns the chain of fewest arcs, two or more, that is within the tolerance of the points, or that of
/// max_arcs, or of as many as have room; nothing where two have none.
[[nodiscard]] std::optional<ArcChain> fit_fewest_arcs(std::span<const CenterPoint> points,
                                                      const ChainLimits& limits);

}  // namespace goffer::fit
