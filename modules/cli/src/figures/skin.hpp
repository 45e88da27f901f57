// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

/// Linear-blend skinning, which goffer is compared with. In double.

namespace goffer::cli {

/// A model on a chain of bones of equal length, along its axis or rest arc, the first of which stays. Each
/// joint turns by the same share of the angle. A vertex follows two bones, by weights that are linear between
/// the bones' middles.
class Skin {
public:
    /// `model`, of one region, must outlive the skin. `bones`: 2 or more.
    Skin(const BoundModel& model, int bones);

    /// The positions of model.rest when the chain turns by `by` radians from rest, in the plane of the rest
    /// arc.
    [[nodiscard]] std::vector<glm::vec3> positions(double by) const;

private:
    struct Weights {
        std::size_t bone = 0;  ///< and the next one
        double next = 0;       ///< the share of that
    };

    /// Where the bones begin at rest: on the center line.
    [[nodiscard]] std::vector<glm::dvec3> joints() const;
    /// From rest to the chain that has turned `by`, for each bone.
    [[nodiscard]] std::vector<glm::dmat4> moves(double by) const;

    const BoundModel& model_;
    int bones_;
    glm::dvec3 along_, toward_;     // of the base end: its axis, and where it bends
    std::vector<Weights> weights_;  // of each vertex
};

}  // namespace goffer::cli
