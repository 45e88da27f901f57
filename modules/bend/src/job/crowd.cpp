// SPDX-License-Identifier: MIT
#include "pose/instance.hpp"
#include "job/run.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/parallel.hpp>
#include <goffer/simd/fence.hpp>

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

bool has_turn(const CrowdJob& job, std::size_t instance) noexcept {
    return job.every.empty() || job.every[instance] <= 1 || (job.frame + instance) % job.every[instance] == 0;
}

bool is_active(const CrowdJob& job, std::size_t instance) noexcept {
    return has_turn(job, instance) && (job.visible.empty() || job.visible[instance] != 0) &&
           (job.changed.empty() || job.changed[instance] != 0);
}

std::size_t vertex_bytes(const DeformJob& job) noexcept {
    return (job.positions.empty() ? 0u : 12u) + (job.normals.empty() ? 0u : 12u) +
           (job.tangents.empty() ? 0u : 16u) + (job.packed.empty() ? 0u : 12u) +
           (job.previous_positions.empty() ? 0u : 12u);
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
        size.bytes += count * vertex_bytes(job.instances[i]);
    }
    return size;
}

bool streams(const CrowdJob& job, std::size_t bytes) noexcept {
    return job.stores == Stores::streaming ||
           (job.stores == Stores::automatic && bytes >= streaming_threshold);
}

/// Passes over instances of one body that are run together, block by block.
class Group {
public:
    [[nodiscard]] bool takes(const DeformJob& job) const noexcept {
        return count_ == 0 || (count_ + pass_count <= capacity && passes_[0].job->body == job.body);
    }

    /// Returns whether the pose was clamped.
    bool add(const DeformJob& job, bool leave_bounds) noexcept {
        const PreparedJob prepared = prepare(job, passes_ + count_, leave_bounds);
        count_ += prepared.passes;
        return prepared.clamped;
    }

    /// Deforms the vertices [first, last) of all, and empties the group.
    void run(std::size_t first, std::size_t last, bool streaming) noexcept {
        by_region(passes_, count_, first, last,
                  [&](std::size_t begin, std::size_t end) { run_blocks(begin, end, streaming); });
        count_ = 0;
    }

    void run(bool streaming) noexcept {
        if (count_ != 0) run(0, passes_[0].job->body->vertex_count(), streaming);
    }

private:
    void run_blocks(std::size_t first, std::size_t last, bool streaming) const noexcept {
        for (; first < last; first += block_vertices) {
            const std::size_t end = std::min(first + block_vertices, last);
            for (std::size_t i = 0; i < count_; ++i) run_pass(passes_[i], first, end, streaming);
        }
    }

    static constexpr std::size_t capacity = group_size + pass_count - 1;
    PreparedPass passes_[capacity];
    std::size_t count_ = 0;
};

/// Deforms what lies between two places. An instance counts where its first vertex lies.
CrowdResult run_between(const CrowdJob& job, Place from, Place to, bool streaming) noexcept {
    Group group;
    CrowdResult result;
    const std::size_t end = to.vertex == 0 ? to.instance : to.instance + 1;
    for (std::size_t i = from.instance; i < end; ++i) {
        if (!is_active(job, i)) continue;
        const DeformJob& instance = job.instances[i];
        const std::size_t count = instance.body->vertex_count();
        const std::size_t first = i == from.instance ? from.vertex : 0;
        const std::size_t last = i == to.instance ? to.vertex : count;
        const bool whole = first == 0 && last == count;
        if (!whole || !group.takes(instance)) group.run(streaming);
        const bool clamped = group.add(instance, first == 0);
        if (first == 0) {
            ++result.deformed;
            result.clamped += clamped ? 1 : 0;
        }
        if (!whole) group.run(first, last, streaming);
    }
    group.run(streaming);
    if (streaming) simd::fence();
    return result;
}

/// Where piece `piece` of `pieces` begins, for a crowd of `vertices` active vertices. Places are asked for in
/// order: `cursor` is where the last one was found.
struct Cursor {
    Place place = {};
    std::size_t before = 0;  // active vertices before place.instance
};

Place begin_of(const CrowdJob& job, std::size_t vertices, std::size_t piece, std::size_t pieces,
               Cursor& cursor) noexcept {
    const std::size_t wanted = piece * vertices / pieces;
    if (piece == pieces) return {job.instances.size(), 0};
    for (std::size_t i = cursor.place.instance; i < job.instances.size(); ++i) {
        if (!is_active(job, i)) continue;
        const std::size_t size = job.instances[i].body->vertex_count();
        if (wanted < cursor.before + size) {
            // On whole lines, so that no two pieces stream into the same one.
            cursor.place = {i, (wanted - cursor.before) / line_floats * line_floats};
            return cursor.place;
        }
        cursor.before += size;
        cursor.place.instance = i + 1;
    }
    return {job.instances.size(), 0};
}

}  // namespace

std::string_view describe(const CrowdFault& fault) noexcept {
    if (fault.visible_count) return "visible: neither empty nor one per instance";
    if (fault.changed_count) return "changed: neither empty nor one per instance";
    if (fault.every_count) return "every: neither empty nor one per instance";
    return describe(fault.fault);
}

CrowdFault validate(const CrowdJob& job) noexcept {
    CrowdFault result;
    const std::size_t count = job.instances.size();
    result.visible_count = !job.visible.empty() && job.visible.size() != count;
    result.changed_count = !job.changed.empty() && job.changed.size() != count;
    result.every_count = !job.every.empty() && job.every.size() != count;
    if (!result.none()) return result;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_active(job, i)) continue;
        result.fault = validate(job.instances[i]);
        result.instance = i;
        if (!result.none()) return result;
    }
    return {};
}

CrowdResult run(const CrowdJob& job) noexcept {
    return run_between(job, {0, 0}, {job.instances.size(), 0}, streams(job, size_of(job).bytes));
}

CrowdResult run_piece(const CrowdJob& job, std::size_t piece, std::size_t pieces) noexcept {
    const Size size = size_of(job);
    Cursor cursor;
    const Place from = begin_of(job, size.vertices, piece, pieces, cursor);
    const Place to = begin_of(job, size.vertices, piece + 1, pieces, cursor);
    return run_between(job, from, to, streams(job, size.bytes));
}

CrowdResult run_parallel(const CrowdJob& job) {
    const Size size = size_of(job);
    const bool streaming = streams(job, size.bytes);
    const std::size_t pieces = std::clamp<std::size_t>(size.vertices / least_vertices, 1, most_pieces);
    Place places[most_pieces + 1];
    Cursor cursor;
    for (std::size_t piece = 0; piece <= pieces; ++piece) {
        places[piece] = begin_of(job, size.vertices, piece, pieces, cursor);
    }
    std::atomic<std::size_t> deformed = 0;
    std::atomic<std::size_t> clamped = 0;
    parallel_ranges(pieces, 1, [&](std::size_t first, std::size_t last) {
        for (; first < last; ++first) {
            const CrowdResult part = run_between(job, places[first], places[first + 1], streaming);
            deformed.fetch_add(part.deformed, std::memory_order_relaxed);
            clamped.fetch_add(part.clamped, std::memory_order_relaxed);
        }
    });
    return {deformed.load(), clamped.load()};
}

}  // namespace goffer::bend
