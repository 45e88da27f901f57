// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"

#include <goffer/bend/job.hpp>

namespace goffer::bend {

/// The bounds of an instance from its coefficients and squeezes, one each per region.
[[nodiscard]] Bounds bounds_of(const BodyData& body, const Coefficients* k, const Squeeze* squeezes) noexcept;

}  // namespace goffer::bend
