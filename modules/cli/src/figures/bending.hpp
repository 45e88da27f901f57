// SPDX-License-Identifier: MIT
#pragma once

#include "figures/figure.hpp"
#include "local_area.hpp"
#include "model.hpp"
#include "textures.hpp"

#include <goffer/bend/pose.hpp>

#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string>

/// A model in one pose, for a picture and a row of a table.

namespace goffer::cli {

/// What a bend made of a model: the numbers are those of `goffer bend --json`.
struct BentState {
    bend::Pose pose;
    mesh::VertexArrays records;  ///< in the order of the model
    double area_change = 0, bare_area_change = 0;
    LocalArea local;
    std::optional<double> base_area_change;
    double wrinkle_depth = 0;
};

/// The pose that bends a body of one region by `degrees` from its rest pose, in the plane of its rest arc.
[[nodiscard]] bend::Pose pose_by(const bend::Body& body, double degrees);

/// The largest such angle, degrees, for which the body does not fold through itself.
[[nodiscard]] double largest_by(const bend::Body& body);

/// Bends a model of one region.
[[nodiscard]] BentState bent_state(const BoundModel& model, const bend::Pose& pose, bool wrinkled = true);

/// Takes a picture of it, which the workshop's files put in its place. `colors`, `textures`: as BentModel has
/// them.
void draw_state(Workshop& workshop, const BoundModel& model, const BentState& state,
                std::span<const glm::vec4> colors, const Textures& textures, const std::string& file);

/// A name for a picture: "NAME_30.png". Angles that are not whole keep one decimal.
[[nodiscard]] std::string picture_name(const std::string& name, double degrees);

}  // namespace goffer::cli
