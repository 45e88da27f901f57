// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/closed_form.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

/// A chain of regions. Each bends along an arc of its own and begins in the frame that the end of the one
/// before carries, without twist. In double. The paper has one region only.
/// See modules/paper/README.md, "Regions".

namespace goffer::paper {

/// The frame of a cross-section, in the body frame of the whole chain.
struct Frame {
    glm::dmat3 axes{1};    ///< columns e1, e2, e3
    glm::dvec3 origin{0};  ///< center of the cross-section, model units
};

/// Returns the frame that the end of a region carries. `base`: the frame that the region begins in. The
/// wrinkle has no part in it. Throws std::invalid_argument as ClosedForm's constructor does for length,
/// radius, folds, angle and direction. Thread-safe.
[[nodiscard]] Frame end_frame(const Frame& base, const Parameters& body, const Pose& pose);

/// Returns the share that the region beyond a joint has in the depth of a wrinkle at `distance` from that
/// joint: a half at the joint, 0 from `blend` > 0 on. It begins and ends level.
[[nodiscard]] double share_of_neighbor(double distance, double blend);

/// The map of a chain of regions, each in a pose of its own. Immutable; thread-safe.
///
/// Where a wave runs on over a joint, wrinkles of both regions pass into each other: within a distance
/// `blend` of the joint the depth at a place is (1 - t) A_own + t A_neighbor, with t of share_of_neighbor().
/// The neighbor's amplitude is that for the thickness of the place, times the ratio of both waves at the
/// joint, so that wrinkles meet there. See modules/paper/README.md, "Folds over joints".
class Chain {
public:
    /// `regions` and `poses` go from base to tip, one pose for each region. `blends` has the distance for
    /// each joint, model units: 0 or more, 0 where wrinkles end at the joint; it may be empty: 0 for all of
    /// them. All are copied. Throws std::invalid_argument if the counts differ or are 0, if blends of a
    /// region overlap, or if one is above 0 at a joint that no wave runs over or where one has no depth, and
    /// as ClosedForm's constructor does.
    Chain(std::span<const Parameters> regions, std::span<const Pose> poses,
          std::span<const double> blends = {});

    /// What ClosedForm's functions of these names return, for a vertex of region `region`, in the body frame
    /// of the whole chain. `rest.z` counts from where the region begins. `region` must be in range.
    [[nodiscard]] glm::dvec3 position(std::size_t region, const Cylindrical& rest) const;
    [[nodiscard]] glm::dvec3 normal(std::size_t region, const Cylindrical& rest,
                                    const CylindricalVector& rest_normal) const;
    [[nodiscard]] glm::dvec3 tangent(std::size_t region, const Cylindrical& rest,
                                     const CylindricalVector& rest_tangent) const;

    /// The frame that region `region` begins in. The reference is valid as long as the chain.
    [[nodiscard]] const Frame& frame(std::size_t region) const { return frames_[region]; }

private:
    /// A joint as a region beside it sees it.
    struct Side {
        double blend = 0;
        double gain = 1;          // on the neighbor's amplitude: its wave over the own one at the joint
        double radius_ratio = 1;  // the own radius over the neighbor's
    };
    /// The two ends of a region.
    struct Ends {
        Side below, above;
    };

    [[nodiscard]] Depth depth(std::size_t region, const Cylindrical& rest) const;
    void add_joint(std::size_t region, double blend);

    std::vector<Parameters> regions_;
    std::vector<ClosedForm> maps_;
    std::vector<Frame> frames_;
    std::vector<Ends> ends_;
};

}  // namespace goffer::paper
