// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace goffer::bend {

/// How far and which way a body is bent: all the state that an instance has. A plain value.
struct Pose {
    /// Rotation angle alpha of the arc, radians: the tip's direction turns by it. Negative: the other way,
    /// which is
    /// (|angle|, direction + pi). Beyond the body's max_angle() it is clamped, and the job's result says so.
    float angle = 0;

    /// Direction theta that the body bends toward, radians about the axis from the body's e1 to its e2. Any
    /// value.
    float direction = 0;

    [[nodiscard]] bool operator==(const Pose&) const noexcept = default;
};

static_assert(sizeof(Pose) == 8 && std::is_trivially_copyable_v<Pose>);

}  // namespace goffer::bend
