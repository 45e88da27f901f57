// SPDX-License-Identifier: MIT
#include "local_area.hpp"

#include <goffer/bend/job.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace goffer::cli {
namespace {

constexpr double largest_shown = 0.5;

/// Where a patch is, for a person: slices and sides count from 1, and a side is named by its middle.
std::string place(std::uint32_t patch, const fit::PatchGrid& grid) {
    const auto sides = static_cast<std::uint32_t>(grid.sides);
    return "slice " + std::to_string(patch / sides + 1) + ", side toward " +
           std::to_string(patch % sides * 360 / sides);
}

std::string words(const fit::PatchChange& change, const fit::PatchGrid& grid) {
    return "rms " + number(100 * change.rms) + " %, worst " + percent(change.worst) + " (" +
           place(change.worst_patch, grid) + ")";
}

nlohmann::ordered_json numbers(const fit::PatchChange& change, const fit::PatchGrid& grid) {
    const auto sides = static_cast<std::uint32_t>(grid.sides);
    return {{"rms", change.rms},
            {"worst", change.worst},
            {"worst_slice", change.worst_patch / sides},
            {"worst_side", change.worst_patch % sides}};
}

}  // namespace

std::vector<glm::vec3> bent_positions(const BoundModel& model, std::span<const bend::Pose> poses,
                                      float wrinkle_weight) {
    const bend::Body& body = model.binding.body;
    std::vector<glm::vec3> positions(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = wrinkle_weight};
    job.positions = interleaved<3>(&positions.front().x, positions.size());
    bend::run(job);
    put_in_model_order(positions, model.binding);
    return positions;
}

LocalArea local_area(const BoundModel& model, std::span<const bend::Pose> poses,
                     std::span<const glm::vec3> positions) {
    LocalArea local;
    const fit::Geometry geometry = geometry_of(model.rest);
    const std::vector<std::uint32_t> patches = fit::patches_of(geometry, model.cylinder, local.grid);
    local.bent = fit::patch_change(geometry, positions, patches);
    local.without_wrinkles = fit::patch_change(geometry, bent_positions(model, poses, 0), patches);
    return local;
}

fit::PatchChange report_local_area(Report& report, const BoundModel& model, std::span<const bend::Pose> poses,
                                   std::span<const glm::vec3> positions) {
    const auto [grid, bent, plain] = local_area(model, poses, positions);
    report.json["local_area_change"] = {{"slices", grid.slices},
                                        {"sides", grid.sides},
                                        {"patches", bent.patches},
                                        {"bent", numbers(bent, grid)},
                                        {"without_wrinkles", numbers(plain, grid)}};
    report.line("local change", words(bent, grid) + " of " + std::to_string(bent.patches) + " patches");
    report.line("without wrinkles", words(plain, grid));
    return bent;
}

std::vector<glm::vec4> area_colors(const BoundModel& model, std::span<const glm::vec3> positions) {
    constexpr glm::vec3 kept{0.72f}, smaller{0.02f, 0.07f, 0.62f}, larger{0.62f, 0.02f, 0.02f};
    std::vector<glm::vec4> colors;
    for (const double change : fit::vertex_change(geometry_of(model.rest), positions)) {
        const auto share = static_cast<float>(std::min(std::fabs(change) / largest_shown, 1.0));
        colors.emplace_back(glm::mix(kept, change < 0 ? smaller : larger, share), 1);
    }
    return colors;
}

void report_area_colors(Report& report) {
    report.json["show"] = {
        {"quantity", "area"}, {"blue", -largest_shown}, {"white", 0}, {"red", largest_shown}};
    const std::string most = number(100 * largest_shown);
    report.line("colors",
                "change of area: blue -" + most + " % or less, white 0, red +" + most + " % or more");
}

}  // namespace goffer::cli
