// SPDX-License-Identifier: MIT
#include "figures/bending.hpp"

#include "deformed.hpp"
#include "picture.hpp"
#include "poses.hpp"
#include "progress.hpp"

#include <goffer/fit/base.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace goffer::cli {

bend::Pose pose_by(const bend::Body& body, double degrees) {
    PoseWords words;
    words.by = "0";
    PoseRequest request(words);
    request.shared = degrees;
    return poses_of(targets_on(body, request))[0];
}

double largest_by(const bend::Body& body) {
    return degrees(static_cast<double>(body.max_angle()) - std::fabs(double{pose_by(body, 0).angle}));
}

BentState bent_state(const BoundModel& model, const bend::Pose& pose, bool wrinkled) {
    BentState state;
    state.pose = pose;
    const std::array poses{pose};
    bend::DeformJob job = job_into(state.records, model, poses);
    if (!wrinkled) job.wrinkle_weight = 0;
    bend::run(job);
    put_in_model_order(state.records, model.binding);

    const std::vector<std::uint32_t>& triangles = model.rest.triangles;
    const auto change = [&](std::span<const glm::vec3> positions) {
        return fit::surface_area(positions, triangles) / fit::surface_area(model.rest.positions, triangles) -
               1;
    };
    state.area_change = change(state.records.positions);
    state.bare_area_change = change(bent_positions(model, poses, 0));
    state.local = local_area(model, poses, state.records.positions);
    const std::array used{used_angle(model.binding.body, 0, pose)};
    state.base_area_change = fit::base_area_change(model.binding, used);
    state.wrinkle_depth = wrinkled ? fit::wrinkle_depth(model.binding, 0, used[0]) : 0;
    return state;
}

void draw_state(Workshop& workshop, const BoundModel& model, const BentState& state,
                std::span<const glm::vec4> colors, const Textures& textures, const std::string& file) {
    const Progress progress("drawing " + file);
    PictureStyle style;
    style.settings = workshop.picture;
    write_picture({model.binding.body, model.mesh, model.rest, state.records.positions, state.records.normals,
                   colors, textures, std::span(&state.pose, 1)},
                  style, workshop.folder / file, workshop.files);
}

std::string picture_name(const std::string& name, double degrees) {
    char text[32];
    std::snprintf(text, sizeof text, degrees == std::round(degrees) ? "%.0f" : "%.1f", degrees);
    return name + "_" + text + ".png";
}

}  // namespace goffer::cli
