// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace goffer::bend {

/// How far and which way a region is bent. One per region is all the state of an instance. A plain value.
struct Pose {
    /// Angle alpha of the arc, by which the region's end turns, radians. A negative angle bends the other
    /// way, like (|angle|, direction + pi). An |angle| beyond the region's max_angle is clamped to it, and
    /// the result of a run says so.
    float angle = 0;

    /// Direction theta that the region bends toward, radians about the axis, from e1 toward e2 of the frame
    /// in which the region begins: for the first region, of Body::axes(). Any finite value.
    float direction = 0;

    [[nodiscard]] bool operator==(const Pose&) const noexcept = default;
};

static_assert(sizeof(Pose) == 8 && std::is_trivially_copyable_v<Pose>);

}  // namespace goffer::bend
