// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "report.hpp"

#include <string>

namespace goffer::cli {

/// Warns, in one line that starts with `where`, of a body that is no cylinder: it is bent all the same, but
/// may look odd. Warns likewise of one that is far from the origin, and of stray vertices. Puts what was
/// found into `json`, as "suitability". Returns whether it is none.
bool report_suitability(Report& report, const BoundModel& model, nlohmann::ordered_json& json,
                        const std::string& where);
inline bool report_suitability(Report& report, const BoundModel& model) {
    return report_suitability(report, model, report.json, {});
}

}  // namespace goffer::cli
