// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/kernel_args.hpp"

#include <goffer/bend/job.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace goffer::bend {

/// The poses of a job's regions: its one pose, or its span.
[[nodiscard]] inline const Pose* poses_of(const DeformJob& job) noexcept {
    return job.poses.empty() ? &job.pose : job.poses.data();
}
[[nodiscard]] inline const Pose* previous_poses_of(const DeformJob& job) noexcept {
    return job.previous_poses.empty() ? &job.previous_pose : job.previous_poses.data();
}

/// A pose of a body: what its regions' coefficients are made from.
struct Posed {
    const Body* body;
    const Pose* poses;  ///< one per region
    const glm::mat4x3* transform;
    bool wrinkles;
};

/// Makes the coefficients of one region, which begins at `from`: everything in the map that depends on the
/// pose and not on the vertex. Sets `to`, which is not `from`, to where the next region begins, if there is
/// one. Tens of nanoseconds; does not allocate.
void prepare_region(const Posed& posed, std::size_t region, const Joint& from, Coefficients& k,
                    Joint& to) noexcept;

/// Calls visit(region, k) for each region of `posed`, from base to tip, with its coefficients.
template <class Visit>
void each_region(const Posed& posed, const Visit& visit) noexcept {
    Coefficients k;
    Joint from = posed.body->frame().base, to;
    for (std::size_t r = 0; r < posed.body->region_count(); ++r, from = to) {
        prepare_region(posed, r, from, k, to);
        visit(r, k);
    }
}

/// Whether an angle is beyond its region's limit, and will be cut to it.
[[nodiscard]] inline bool is_clamped(const Body& body, const Pose* poses) noexcept {
    for (const Region& region : body.regions()) {
        const float angle = poses++->angle;
        if ((angle < 0 ? -angle : angle) > region.max_angle) return true;
    }
    return false;
}

/// The bounds of the instance. `k`: region 0's coefficients; `second`: where region 1 begins,
/// if there is one.
[[nodiscard]] Bounds bounds_of(const Posed& posed, const Coefficients& k, const Joint& second) noexcept;

/// A run of a kernel over an instance's vertices: which outputs it is for.
enum class Pass : std::uint8_t { current, previous, packed };
constexpr std::size_t pass_count = 3;

/// A pass, ready for the vertices of one region; regions follow from base to tip.
struct PreparedPass {
    const DeformJob* job;
    Pass pass;
    std::size_t region;
    Joint next;           ///< where the region after begins, if there is one
    glm::vec3 low, high;  ///< bounds of packed vertices
    Coefficients coefficients;

    [[nodiscard]] Posed posed() const noexcept {
        const bool previous = pass == Pass::previous;
        return {job->body, previous ? previous_poses_of(*job) : poses_of(*job),
                previous ? &job->previous_transform : &job->transform, job->wrinkles};
    }

    /// On to the next region, of which there must be one.
    void advance() noexcept;
};

struct PreparedJob {
    std::size_t passes = 0;  ///< how many were written
    bool clamped = false;    ///< the current pose was
};

/// Prepares the passes that `job` asks for, for their first region, into `passes`, which has room for
/// pass_count. With `leave_bounds`, also leaves the bounds where the job wants them.
[[nodiscard]] PreparedJob prepare(const DeformJob& job, PreparedPass* passes, bool leave_bounds) noexcept;

/// Calls run(begin, end) for each part of the vertices [first, last) that lies in one region, when all of
/// `passes` (which are at their first region, of one body) are ready for that region.
template <class Run>
void by_region(PreparedPass* passes, std::size_t count, std::size_t first, std::size_t last,
               const Run& run) noexcept {
    if (count == 0) return;
    const std::span<const Region> regions = passes[0].job->body->regions();
    if (regions.size() == 1) {
        if (first < last) run(first, last);
        return;
    }
    for (std::size_t r = 0;;) {
        const std::size_t begin = first > regions[r].first ? first : regions[r].first;
        const std::size_t end = last < regions[r].last ? last : regions[r].last;
        if (begin < end) run(begin, end);
        if (++r == regions.size() || regions[r].first >= last) return;
        for (std::size_t i = 0; i < count; ++i) passes[i].advance();
    }
}

}  // namespace goffer::bend
