// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/closed_form.hpp>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

/// Regions in a row: each bends along an arc of its own and begins in the frame that the end of
/// the one before carries, without twist. In double; not in the paper, which has one region.
/// See modules/paper/README.md, "Regions".

namespace goffer::paper {

/// A frame in the body frame of the whole: columns e1, e2, e3 of `axes`, and the center of a cross-section.
struct Frame {
    glm::dmat3 axes{1};
    glm::dvec3 origin{0};
};

/// The frame that the end of `body`, bare and bent by `pose`, carries, if it begins in `base`. Throws as
/// ClosedForm's constructor. Thread-safe.
[[nodiscard]] Frame end_frame(const Frame& base, const Parameters& body, const Pose& pose);

/// The map of a chain of regions in one pose each. Immutable; thread-safe.
class Chain {
public:
    /// `regions` and `poses`: from base to tip, as many. Throws as ClosedForm's constructor, and
    /// std::invalid_argument where the counts differ or are 0.
    Chain(std::span<const Parameters> regions, std::span<const Pose> poses);

    /// As ClosedForm's, for a vertex of region `region`, with z from where that begins; results in the body
    /// frame of the whole.
    [[nodiscard]] glm::dvec3 position(std::size_t region, const Cylindrical& rest) const;
    [[nodiscard]] glm::dvec3 normal(std::size_t region, const Cylindrical& rest,
                                    const CylindricalVector& rest_normal) const;
    [[nodiscard]] glm::dvec3 tangent(std::size_t region, const Cylindrical& rest,
                                     const CylindricalVector& rest_tangent) const;

    /// Where region `region` begins.
    [[nodiscard]] const Frame& frame(std::size_t region) const { return frames_[region]; }

private:
    std::vector<ClosedForm> maps_;
    std::vector<Frame> frames_;
};

}  // namespace goffer::paper
