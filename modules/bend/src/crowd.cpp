// SPDX-License-Identifier: MIT
#include "instance.hpp"
#include "run.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <atomic>

namespace goffer::bend {
namespace {

constexpr std::size_t block_vertices =
    512;  // their rest columns, nine or twelve of them, stay in the first-level cache
constexpr std::size_t group_size = 16;        // instances that share a block while it is there
constexpr std::size_t most_pieces = 256;      // of a frame, for the scheduler to hand out
constexpr std::size_t least_vertices = 8192;  // of a piece, so that handing it out is not the work

/// A place in the crowd: a vertex of an instance.
struct Place {
    std::size_t instance = 0;
    std::size_t vertex = 0;
};

bool is_active(const CrowdJob& job, std::size_t instance) noexcept {
    return job.active.empty() || job.active[instance] != 0;
}

std::size_t output_floats(const DeformJob& job) noexcept {
    return (job.positions.empty() ? 0u : 3u) + (job.normals.empty() ? 0u : 3u) +
           (job.tangents.empty() ? 0u : 4u);
}

struct Size {
    std::size_t vertices = 0;
    std::size_t bytes = 0;
};

Size size_of(const CrowdJob& job) noexcept {
    Size size;
    for (std::size_t i = 0; i < job.instances.size(); ++i) {
        if (!is_active(job, i)) continue;
        const std::size_t count = job.instances[i].body->vertex_count();
        size.vertices += count;
        size.bytes += count * output_floats(job.instances[i]) * sizeof(float);
    }
    return size;
}

bool streams(const CrowdJob& job, std::size_t bytes) noexcept {
    return job.stores == Stores::streaming ||
           (job.stores == Stores::automatic && bytes >= streaming_threshold);
}

/// Instances of one body that are deformed together, block by block.
class Group {
public:
    [[nodiscard]] bool takes(const DeformJob& job) const noexcept {
        return count_ == 0 || (count_ < group_size && jobs_[0]->body == job.body);
    }

    /// Returns whether the pose was clamped.
    bool add(const DeformJob& job) noexcept {
        bool clamped = false;
        coefficients_[count_] = prepare(*job.body, job.pose, clamped);
        jobs_[count_++] = &job;
        return clamped;
    }

    /// Deforms the vertices [first, last) of all, and empties the group.
    void run(std::size_t first, std::size_t last, bool streaming) noexcept {
        for (; first < last; first += block_vertices) {
            const std::size_t end = std::min(first + block_vertices, last);
            for (std::size_t i = 0; i < count_; ++i)
                run_prepared(*jobs_[i], coefficients_[i], first, end, streaming);
        }
        count_ = 0;
    }

    void run(bool streaming) noexcept {
        if (count_ != 0) run(0, jobs_[0]->body->vertex_count(), streaming);
    }

private:
    Coefficients coefficients_[group_size];
    const DeformJob* jobs_[group_size];
    std::size_t count_ = 0;
};

/// Deforms what lies between two places. An instance counts as clamped where its first vertex lies.
std::size_t run_between(const CrowdJob& job, Place from, Place to, bool streaming) noexcept {
    Group group;
    std::size_t clamped = 0;
    const std::size_t end = to.vertex == 0 ? to.instance : to.instance + 1;
    for (std::size_t i = from.instance; i < end; ++i) {
        if (!is_active(job, i)) continue;
        const DeformJob& instance = job.instances[i];
        const std::size_t count = instance.body->vertex_count();
        const std::size_t first = i == from.instance ? from.vertex : 0;
        const std::size_t last = i == to.instance ? to.vertex : count;
        const bool whole = first == 0 && last == count;
        if (!whole || !group.takes(instance)) group.run(streaming);
        const bool was_clamped = group.add(instance);
        clamped += first == 0 && was_clamped ? 1 : 0;
        if (!whole) group.run(first, last, streaming);
    }
    group.run(streaming);
    return clamped;
}

/// Cuts the crowd's active vertices into `count` pieces of about the same size. Places[i] begins piece i.
void cut(const CrowdJob& job, std::size_t vertices, std::size_t count, Place* places) noexcept {
    std::size_t before = 0;
    std::size_t piece = 0;
    for (std::size_t i = 0; i < job.instances.size(); ++i) {
        if (!is_active(job, i)) continue;
        const std::size_t size = job.instances[i].body->vertex_count();
        for (; piece < count && piece * vertices / count < before + size; ++piece) {
            // On whole lines, so that no two pieces stream into the same one.
            places[piece] = {i, (piece * vertices / count - before) / line_floats * line_floats};
        }
        before += size;
    }
    for (; piece <= count; ++piece) places[piece] = {job.instances.size(), 0};
}

}  // namespace

CrowdFault validate(const CrowdJob& job) noexcept {
    if (!job.active.empty() && job.active.size() != job.instances.size()) return {JobFault::none, 0, true};
    for (std::size_t i = 0; i < job.instances.size(); ++i) {
        if (!is_active(job, i)) continue;
        const JobFault fault = validate(job.instances[i]);
        if (fault != JobFault::none) return {fault, i, false};
    }
    return {};
}

CrowdResult run(const CrowdJob& job) noexcept {
    return {run_between(job, {0, 0}, {job.instances.size(), 0}, streams(job, size_of(job).bytes))};
}

CrowdResult run_parallel(const CrowdJob& job) {
    const Size size = size_of(job);
    const bool streaming = streams(job, size.bytes);
    const std::size_t pieces = std::clamp<std::size_t>(size.vertices / least_vertices, 1, most_pieces);
    Place places[most_pieces + 1];
    cut(job, size.vertices, pieces, places);
    std::atomic<std::size_t> clamped = 0;
    parallel_ranges(pieces, 1, [&](std::size_t first, std::size_t last) {
        for (; first < last; ++first) {
            clamped.fetch_add(run_between(job, places[first], places[first + 1], streaming),
                              std::memory_order_relaxed);
        }
    });
    return {clamped.load()};
}

}  // namespace goffer::bend
