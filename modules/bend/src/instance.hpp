// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_args.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>

namespace goffer::bend {

/// The coefficients of one instance: everything in the map that depends on the pose and not on the vertex.
/// `clamped` says whether the angle was cut to the body's limit. Tens of nanoseconds; does not allocate.
[[nodiscard]] Coefficients prepare(const Body& body, const Pose& pose, bool& clamped) noexcept;

}  // namespace goffer::bend
