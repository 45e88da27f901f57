// SPDX-License-Identifier: MIT
#include "deformed.hpp"

#include <cstddef>
#include <string>

namespace goffer::cli {

bend::DeformJob job_into(mesh::VertexArrays& records, const BoundModel& model,
                         std::span<const bend::Pose> poses, Isa isa, const glm::mat4x3& transform) {
    const bend::Body& body = model.binding.body;
    const std::size_t count = body.vertex_count();
    records = model.rest;
    records.normals.resize(count);
    bend::DeformJob job;
    job.body = &body;
    job.poses = poses;
    job.isa = isa;
    job.transform = transform;
    job.positions = interleaved<3>(&records.positions.front().x, count);
    job.normals = interleaved<3>(&records.normals.front().x, count);
    if (body.has_tangents()) job.tangents = interleaved<4>(&records.tangents.front().x, count);
    if (const bend::Fault fault = bend::validate(job); !fault.none())
        throw InputError("cannot deform: " + std::string(bend::describe(fault)));
    return job;
}

void put_in_model_order(mesh::VertexArrays& records, const fit::Binding& binding) {
    put_in_model_order(records.positions, binding);
    put_in_model_order(records.normals, binding);
    put_in_model_order(records.tangents, binding);
}

mesh::Mesh bent_mesh(const BoundModel& model, std::span<const bend::Pose> poses) {
    mesh::VertexArrays records;
    bend::run_parallel(job_into(records, model, poses));
    put_in_model_order(records, model.binding);
    return mesh::with_vertex_arrays(model.mesh, records);
}

std::string ending_of(const BoundModel& model) {
    return mesh::can_save(model.file) ? model.file.extension().string() : ".glb";
}

}  // namespace goffer::cli
