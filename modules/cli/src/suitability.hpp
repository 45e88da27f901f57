// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "report.hpp"

namespace goffer::cli {

/// Warns, in one line, of a body that is no cylinder: it is bent all the same, but may look odd. Puts what
/// was found into the JSON, as "suitability". Returns whether it is none.
bool report_suitability(Report& report, const BoundModel& model);

}  // namespace goffer::cli
