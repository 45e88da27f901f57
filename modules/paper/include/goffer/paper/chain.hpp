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

/// The map of a chain of regions, each in a pose of its own. Immutable; thread-safe.
class Chain {
public:
    /// `regions` and `poses` go from base to tip, one pose for each region. Both are copied. Throws
    /// std::invalid_argument if the counts differ or are 0, and as ClosedForm's constructor does.
    Chain(std::span<const Parameters> regions, std::span<const Pose> poses);

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
    std::vector<ClosedForm> maps_;
    std::vector<Frame> frames_;
};

}  // namespace goffer::paper
