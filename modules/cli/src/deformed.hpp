// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/job.hpp>

#include <span>

/// A model bent on the processor, as it is written to a file.

namespace goffer::cli {

/// The job that bends `model` into `records`, which become the model's own at rest, with normals; in the
/// body's order. Throws InputError where there is no such job. `records` and `poses` must outlive it.
[[nodiscard]] bend::DeformJob job_into(mesh::VertexArrays& records, const BoundModel& model,
                                       std::span<const bend::Pose> poses, Isa isa = Isa::automatic);

/// Puts what such a job has written into the model's order.
void put_in_model_order(mesh::VertexArrays& records, const fit::Binding& binding);

}  // namespace goffer::cli
