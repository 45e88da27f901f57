// SPDX-License-Identifier: MIT
#pragma once

#include "crowd/crowd.hpp"

#include <cstddef>
#include <optional>

namespace goffer::cli {

class Progress;

/// What a number of frames took.
struct Timing {
    double frame_median = 0;                 ///< ms
    double frame_p99 = 0;                    ///< ms; one frame in a hundred takes longer
    double fill_median = 0;                  ///< ms, of a fill of the same bytes past the cache
    std::optional<double> allocations = {};  ///< per frame; nothing where they are not counted
    std::size_t clamped = 0;                 ///< poses of the last frame
};

/// Deforms `crowd` for frames 0 .. `frames` - 1, `frames` > 0, after some that do not count, on `threads`
/// threads; one thread is the calling one, without a scheduler. What is timed and counted is the run of the
/// crowd's job. Every few frames the crowd's memory is filled, and a frame after it does not count, since the
/// fill has emptied the cache. `progress` advances by a step a frame. The last frame is what the memory holds
/// in the end.
[[nodiscard]] Timing measure(Crowd& crowd, std::size_t frames, int threads, Progress& progress);

}  // namespace goffer::cli
