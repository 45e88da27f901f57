// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/job.hpp>

#include <glm/mat4x3.hpp>

#include <span>
#include <string>

/// A model bent on the processor, as it is written to a file.

namespace goffer::cli {

/// The job that bends `model` into `records`, which become the model's own at rest, with normals; in the
/// body's order, under `transform`. Throws InputError where there is no such job. `records` and `poses` must
/// outlive it.
[[nodiscard]] bend::DeformJob job_into(mesh::VertexArrays& records, const BoundModel& model,
                                       std::span<const bend::Pose> poses, Isa isa = Isa::automatic,
                                       const glm::mat4x3& transform = glm::mat4x3(1));

/// Puts what such a job has written into the model's order.
void put_in_model_order(mesh::VertexArrays& records, const fit::Binding& binding);

/// The model in these poses, as `goffer bend` writes it. Throws as job_into().
[[nodiscard]] mesh::Mesh bent_mesh(const BoundModel& model, std::span<const bend::Pose> poses);

/// The ending that its file gets: the model's own, or .glb where save() does not know it.
[[nodiscard]] std::string ending_of(const BoundModel& model);

}  // namespace goffer::cli
