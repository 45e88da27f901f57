// SPDX-License-Identifier: MIT
#include "deformed.hpp"

#include <cstddef>
#include <string>

namespace goffer::cli {

bend::DeformJob job_into(mesh::VertexArrays& records, const BoundModel& model,
                         std::span<const bend::Pose> poses, Isa isa) {
    const bend::Body& body = model.binding.body;
    const std::size_t count = body.vertex_count();
    records = model.rest;
    records.normals.resize(count);
    bend::DeformJob job;
    job.body = &body;
    job.poses = poses;
    job.isa = isa;
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

}  // namespace goffer::cli
