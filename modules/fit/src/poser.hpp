// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Surfaces of a body in poses: what amplitudes that keep its area are solved on.

namespace goffer::fit {

/// A region's surface in one pose, at the places of the body's vertices. The map is linear in the wrinkle's
/// amplitude, so that the bare bend and the wrinkled one give all of them.
struct Surface {
    std::vector<glm::vec3> bare;
    std::vector<glm::vec3> wrinkle;  ///< what the wrinkle adds
};

/// Returns the triangles that have two corners or more in the region, as vertices of the body. `place`: of
/// each vertex of the mesh in the body; empty: its own.
[[nodiscard]] std::vector<std::uint32_t> triangles_of(const bend::Region& region,
                                                      std::span<const std::uint32_t> triangles,
                                                      std::span<const std::uint32_t> place);

/// Bends a body, one region at a time, together with those that its folds run on into. Sets the part of the
/// surface that `triangles` need, which are vertices of the body, one at least.
class Poser {
public:
    Poser(const bend::Body& body, std::span<const std::uint32_t> triangles);

    /// Sets `surface` to the body with a region in a pose, and others at rest, but for those that share its
    /// wave: their curvatures change as its own does, as far as they can, so that what passes over the joints
    /// is neither lost nor gained.
    void bend(std::size_t region, const bend::Pose& pose, Surface& surface);

    /// Returns the body at rest.
    [[nodiscard]] Surface rest();

private:
    void deform(float wrinkle_weight, std::vector<glm::vec3>& positions);

    const bend::Body& body_;
    std::size_t first_, last_;
    std::vector<bend::Pose> poses_;
};

}  // namespace goffer::fit
