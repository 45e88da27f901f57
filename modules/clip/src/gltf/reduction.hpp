// SPDX-License-Identifier: MIT
#pragma once

#include "shapes.hpp"

#include <goffer/clip/gltf.hpp>

#include <cstdint>
#include <optional>
#include <vector>

/// Few shapes of which all frames are blends.

namespace goffer::clip {

/// Targets, and how much of each makes a frame.
struct Blend {
    Shapes targets;
    std::vector<float> weights;         ///< 0..1; those of a frame together
    bool exact = false;                 ///< the targets are the frames
    GltfLimit limit = GltfLimit::none;  ///< what keeps them from being as near as is asked, before rounding
};

/// How far a blend is from the frames.
struct BlendError {
    double max = 0, rms = 0;              ///< of positions
    double max_angle = 0, rms_angle = 0;  ///< of normals, radians
};

/// What decides how many targets there are.
struct Reduction {
    double max_error = 0;                     ///< model units
    std::optional<std::size_t> targets = {};  ///< 1 or more, whatever the error
    std::uint64_t memory = 0;                 ///< bytes
};

/// Finds a blend. Throws mesh::Error if the memory is too little, or a frame is not finite.
[[nodiscard]] Blend reduce(Moves& moves, const Reduction& how);

/// Takes out of the targets what is small at rest and in motion, so that sparse accessors become smaller: no
/// vertex is off by more than a hundredth of `tolerance` for it, no normal by more than a tenth of a degree.
void prune(Blend& blend, double tolerance);

[[nodiscard]] BlendError measure(Moves& moves, const Blend& blend);

}  // namespace goffer::clip
