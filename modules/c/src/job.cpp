// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/capsules.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

using namespace goffer;
using namespace goffer::c;

// Poses and capsules are read and written as C++ has them.
static_assert(sizeof(goffer_pose) == sizeof(bend::Pose));
static_assert(sizeof(goffer_capsule) == sizeof(bend::Capsule) &&
              offsetof(goffer_capsule, radius) == offsetof(bend::Capsule, radius));
static_assert(GOFFER_ISA_NEON == static_cast<int>(Isa::neon));

namespace {

std::span<const bend::Pose> poses_of(const goffer_pose* poses, std::size_t count) noexcept {
    return {reinterpret_cast<const bend::Pose*>(poses), poses != nullptr ? count : 0};
}

glm::mat4x3 matrix_of(const float* transform) noexcept {
    return transform != nullptr ? glm::make_mat4x3(transform) : glm::mat4x3(1);
}

template <std::size_t N>
Stream<N> stream_of(const goffer_stream& from) noexcept {
    Stream<N> stream;
    for (std::size_t c = 0; c < N; ++c) stream.component[c] = from.component[c];
    stream.stride = from.stride;
    stream.count = from.count;
    return stream;
}

goffer_job_result result_of(const bend::DeformResult& result) noexcept {
    return {result.clamped ? 1 : 0, result.at_rest ? 1 : 0};
}

}  // namespace

Stream3 goffer::c::stream3(const goffer_stream& stream) noexcept {
    return stream_of<3>(stream);
}

Stream4 goffer::c::stream4(const goffer_stream& stream) noexcept {
    return stream_of<4>(stream);
}

bend::PackedStream goffer::c::packed_of(const goffer_packed_stream& stream) noexcept {
    return {static_cast<bend::PackedVertex*>(stream.first), stream.stride, stream.count};
}

goffer_bounds goffer::c::bounds_of(const bend::Bounds& bounds) noexcept {
    const auto& [low, high] = bounds;
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

bend::DeformJob goffer::c::job_of(const goffer_job& from) noexcept {
    bend::DeformJob job;
    job.body = body_of(from.body);
    job.poses = poses_of(from.poses, from.pose_count);
    job.wrinkle_weight = from.wrinkle_weight;
    job.transform = matrix_of(from.transform);
    job.positions = stream3(from.positions);
    job.normals = stream3(from.normals);
    job.tangents = stream4(from.tangents);
    job.packed = packed_of(from.packed);
    job.previous_positions = stream3(from.previous_positions);
    job.previous_poses = poses_of(from.previous_poses, from.pose_count);
    job.previous_transform = matrix_of(from.previous_transform);
    job.bounds = reinterpret_cast<bend::Bounds*>(from.bounds);
    job.isa = isa_of(from.isa);
    return job;
}

int goffer_isa_runs_here(int isa) {
    return runs_here(isa_of(isa)) ? 1 : 0;
}

goffer_job goffer_job_defaults(void) {
    goffer_job job = {};
    job.wrinkle_weight = 1;
    return job;
}

int goffer_job_validate(const goffer_job* job, goffer_error* error) {
    if (job == nullptr) return say(error, GOFFER_ERROR_ARGUMENT, "job: null"), 0;
    if (job->body == nullptr) return say_fault(error, bend::validate(job_of(*job)));
    // C++ takes no poses for that of a body of one region.
    if (job->poses == nullptr || job->pose_count == 0)
        return say(error, GOFFER_ERROR_ARGUMENT, "poses: none; give one for each region"), 0;
    const float* const* const previous = job->previous_positions.component;
    const bool wanted = std::any_of(previous, previous + 3, [](const float* c) { return c != nullptr; });
    if (wanted && job->previous_poses == nullptr)
        return say(error, GOFFER_ERROR_ARGUMENT, "previous_poses: none; give one for each region"), 0;
    return say_fault(error, bend::validate(job_of(*job)));
}

goffer_job_result goffer_job_run(const goffer_job* job) {
    return result_of(bend::run(job_of(*job)));
}

goffer_job_result goffer_job_run_range(const goffer_job* job, size_t first, size_t last) {
    const bend::DeformJob made = job_of(*job);
    if (first > last || last > made.body->vertex_count()) return {};
    return result_of(bend::run_range(made, first, last));
}

goffer_job_result goffer_job_run_parallel(const goffer_job* job) {
    try {
        return result_of(bend::run_parallel(job_of(*job)));
    } catch (...) {  // the scheduler has no memory
        return goffer_job_run(job);
    }
}

goffer_bounds goffer_job_bounds(const goffer_job* job) {
    if (job == nullptr || job->body == nullptr) return {};
    return bounds_of(bend::bounds(job_of(*job)));
}

void goffer_job_capsules(const goffer_job* job, size_t pieces, goffer_capsule* result) {
    if (job == nullptr || job->body == nullptr) return;
    const bend::DeformJob made = job_of(*job);
    bend::capsules(made, pieces,
                   {reinterpret_cast<bend::Capsule*>(result), bend::capsule_count(*made.body, pieces)});
}
