// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "report.hpp"

#include <goffer/bend/pose.hpp>
#include <goffer/fit/patches.hpp>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <vector>

/// What a bend does to the area of a model here and there, in the report and as colors.

namespace goffer::cli {

/// How the areas of patches change, with wrinkles and without.
struct LocalArea {
    fit::PatchGrid grid;
    fit::PatchChange bent, without_wrinkles;
};

/// Measures that: 12 slices along the body by 4 sides about it. `positions` are those of the bent model, in
/// the order of model.rest.
[[nodiscard]] LocalArea local_area(const BoundModel& model, std::span<const bend::Pose> poses,
                                   std::span<const glm::vec3> positions);

/// The positions of the model bent, with wrinkles of that weight, in the order of model.rest.
[[nodiscard]] std::vector<glm::vec3> bent_positions(const BoundModel& model,
                                                    std::span<const bend::Pose> poses,
                                                    float wrinkle_weight = 1);

/// Says how the areas of patches change, 12 slices along the body by 4 sides about it, and how they would
/// without wrinkles. `positions` are those of the bent model, in the order of model.rest. Returns the change,
/// with wrinkles.
fit::PatchChange report_local_area(Report& report, const BoundModel& model, std::span<const bend::Pose> poses,
                                   std::span<const glm::vec3> positions);

/// A color for every vertex, linear RGBA: blue where the area about it became smaller, white where it was
/// kept, red where it became larger. Changes beyond a half look like a half.
[[nodiscard]] std::vector<glm::vec4> area_colors(const BoundModel& model,
                                                 std::span<const glm::vec3> positions);

/// Says what these colors mean.
void report_area_colors(Report& report);

}  // namespace goffer::cli
