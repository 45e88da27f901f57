// SPDX-License-Identifier: MIT
#include "animate/moving_model.hpp"

#include "deformed.hpp"

#include <goffer/bend/job.hpp>

#include <algorithm>

namespace goffer::cli {

MovingModel::MovingModel(const BoundModel& model, const Motion& motion, std::size_t frames, double rate,
                         Isa isa)
    : model_(model), motion_(motion), frames_(frames), rate_(rate), isa_(isa) {
    (void)moment(0);
}

Moment MovingModel::moment(std::size_t frame) const {
    return motion_.at(static_cast<double>(frame) / rate_, model_.binding.body);
}

mesh::VertexArrays MovingModel::records(const Moment& moment) const {
    mesh::VertexArrays records;
    bend::run_parallel(job_into(records, model_, moment.poses, isa_, moment.transform));
    put_in_model_order(records, model_.binding);
    return records;
}

void MovingModel::read(std::size_t frame, std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
    Moment here = moment(frame);
    here.transform = glm::mat4x3(1.0f);
    const mesh::VertexArrays bent = records(here);
    std::ranges::copy(bent.positions, positions.begin());
    if (!normals.empty()) std::ranges::copy(bent.normals, normals.begin());
}

}  // namespace goffer::cli
