// SPDX-License-Identifier: MIT
#include "job/batch_runner.hpp"
#include "job/check.hpp"
#include "kernel/kernels.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/engine/parallel.hpp>

#include <cassert>

namespace goffer::bend {

Fault validate(const DeformJob& job) noexcept {
    if (job.body != nullptr && !job.body->empty()) {
        const std::size_t regions = job.body->region_count();
        const std::size_t poses = poses_of(job).size(), previous_poses = previous_poses_of(job).size();
        if (poses != regions)
            return {.field = Field::poses, .reason = Reason::count, .has = poses, .needs = regions};
        if (!job.previous_positions.empty() && previous_poses != regions)
            return {.field = Field::previous_poses,
                    .reason = Reason::count,
                    .has = previous_poses,
                    .needs = regions};
    }
    Fault fault = check(batch_of(job));
    fault.instance = Fault::nowhere;
    if (fault.none() && !runs_here(job.isa)) return {.field = Field::isa, .reason = Reason::not_supported};
    return fault;
}

DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept {
    const Batch batch = batch_of(job);
    assert(check_memory(batch).none() && "job must validate, but for poses, weight and transforms");
    assert(poses_of(job).size() == job.body->region_count());
    assert(first <= last && last <= job.body->vertex_count());
    BatchRunner runner(batch, kernels(job.isa), false);
    runner.set_part(first, last);
    runner.add(0);
    runner.finish();
    const PoseState state = state_of(*job.body->data(), poses_of(job));
    return {.clamped = state.clamped, .at_rest = state.at_rest};
}

DeformResult run(const DeformJob& job) noexcept {
    assert(job.body != nullptr);
    return run_range(job, 0, job.body->vertex_count());
}

DeformResult run_parallel(const DeformJob& job, std::size_t grain) {
    assert(job.body != nullptr && !job.body->empty());
    parallel_ranges(job.body->vertex_count(), grain,
                    [&](std::size_t first, std::size_t last) { run_range(job, first, last); });
    const PoseState state = state_of(*job.body->data(), poses_of(job));
    return {.clamped = state.clamped, .at_rest = state.at_rest};
}

}  // namespace goffer::bend
