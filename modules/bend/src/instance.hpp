// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_args.hpp"

#include <goffer/bend/job.hpp>

#include <cstddef>
#include <cstdint>

namespace goffer::bend {

/// Makes the coefficients of one instance: everything in the map that depends on the pose and not on the
/// vertex. Returns whether the angle was beyond the body's limit and was cut to it. Tens of nanoseconds; does
/// not allocate.
bool prepare(const Body& body, const Pose& pose, const glm::mat4x3& transform, Coefficients& k) noexcept;

/// The bounds of the instance that `k` was prepared for.
[[nodiscard]] Bounds bounds_of(const Body& body, const Coefficients& k) noexcept;

/// A run of a kernel over an instance's vertices: which outputs it is for.
enum class Pass : std::uint8_t { current, previous, packed };
constexpr std::size_t pass_count = 3;

struct PreparedPass {
    const DeformJob* job;
    Pass pass;
    Coefficients coefficients;
};

struct PreparedJob {
    std::size_t passes = 0;  ///< how many were written
    bool clamped = false;    ///< the current pose was
};

/// Prepares the passes that `job` asks for, into `passes`, which has room for pass_count. With
/// `leave_bounds`, also leaves the bounds where the job wants them.
[[nodiscard]] PreparedJob prepare(const DeformJob& job, PreparedPass* passes, bool leave_bounds) noexcept;

}  // namespace goffer::bend
