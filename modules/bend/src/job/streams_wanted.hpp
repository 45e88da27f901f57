// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>

namespace goffer::bend {

/// The streams that a job asks for, as bits: the index of its kernel.
[[nodiscard]] inline unsigned streams_wanted(const DeformJob& job) noexcept {
    return (job.positions.empty() ? 0u : 1u) | (job.normals.empty() ? 0u : 2u) |
           (job.tangents.empty() ? 0u : 4u);
}

}  // namespace goffer::bend
