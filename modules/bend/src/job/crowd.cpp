// SPDX-License-Identifier: MIT
#include "job/batch_runner.hpp"
#include "job/check.hpp"
#include "job/lane_runner.hpp"
#include "kernel/kernels.hpp"
#include "pose/matrix_layout.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/parallel.hpp>
#include <goffer/simd/fence.hpp>

#include <algorithm>
#include <atomic>
#include <cassert>

/// Not inlined, so that the stack holds one runner at a time.
#ifdef _MSC_VER
#define GOFFER_OWN_FRAME __declspec(noinline)
#else
#define GOFFER_OWN_FRAME [[gnu::noinline]]
#endif

namespace goffer::bend {
namespace {

constexpr std::size_t max_pieces = 256;
constexpr std::size_t min_vertices = 8192;  // per piece: handing it out must cost less than the work on it

/// What an instance costs in a frame beside its pose and its transform: an element of each other column.
constexpr std::size_t bytes_per_instance = sizeof(Batch::indices[0]) + sizeof(Batch::vertex_offsets[0]) +
                                           sizeof(Batch::wrinkle_weights[0]) + sizeof(Batch::visible[0]) +
                                           sizeof(Batch::changed[0]) + sizeof(Batch::update_intervals[0]);
static_assert(bytes_per_instance <= 32);

/// A place in the crowd: a vertex of a row of instances of a batch. Before it lie the rows before this one,
/// and of each instance of this row the vertices before that one.
struct Place {
    std::size_t batch = 0;
    std::size_t instance = 0;  ///< the first one of the row
    std::size_t vertex = 0;
};

/// How many instances are in a row; the last one may have fewer. Those of large bodies are cut together, so
/// that the columns of a piece serve many instances: those of the whole body may not stay in a cache. A row
/// is set up once for each piece that it is cut into, which must cost less than it saves: with many regions,
/// or bounds of each instance for its packed vertices, it is shorter.
std::size_t row_of(const Batch& batch) noexcept {
    if (batch.body->vertex_count() < min_vertices) return 1;
    const std::size_t cost = batch.body->region_count() * (batch.packed.empty() ? 1 : 4);
    return std::clamp<std::size_t>(2 * setup_width / cost, 1, setup_width);
}

/// Tells which instances of a batch are deformed in this frame: those that are not skipped.
class Activity {
public:
    Activity(const Batch& batch, std::uint32_t frame) noexcept : batch_(batch), frame_(frame) {}

    /// Whether all are for sure, because the batch has no masks.
    [[nodiscard]] bool all() const noexcept {
        return batch_.visible.empty() && batch_.changed.empty() && batch_.update_intervals.empty();
    }
    [[nodiscard]] bool operator[](std::size_t instance) const noexcept {
        if (all()) return true;
        const std::size_t element = element_of(batch_, instance);
        return (batch_.visible.empty() || batch_.visible[element] != 0) &&
               (batch_.changed.empty() || batch_.changed[element] != 0) && has_turn(instance, element);
    }
    [[nodiscard]] std::size_t count() const noexcept { return count(0, batch_.count); }
    /// Of the instances [first, last).
    [[nodiscard]] std::size_t count(std::size_t first, std::size_t last) const noexcept {
        if (all()) return last - first;
        std::size_t active = 0;
        for (std::size_t i = first; i < last; ++i) active += (*this)[i] ? 1 : 0;
        return active;
    }

private:
    [[nodiscard]] bool has_turn(std::size_t instance, std::size_t element) const noexcept {
        if (batch_.update_intervals.empty()) return true;
        const std::uint8_t interval = batch_.update_intervals[element];
        return interval <= 1 || (frame_ + instance) % interval == 0;
    }

    const Batch& batch_;
    std::uint32_t frame_;
};

/// Whether `job` validates, but for its poses, weights and transforms.
[[maybe_unused]] bool may_run(const CrowdJob& job) noexcept {
    return runs_here(job.isa) &&
           std::ranges::all_of(job.batches, [](const Batch& batch) { return check_memory(batch).none(); });
}

struct Size {
    std::size_t vertices = 0;
    std::size_t bytes = 0;
};

Size size_of(const CrowdJob& job) noexcept {
    Size size;
    for (const Batch& batch : job.batches) {
        const std::size_t vertices = Activity(batch, job.frame).count() * batch.body->vertex_count();
        size.vertices += vertices;
        size.bytes += vertices * vertex_bytes(batch);
    }
    return size;
}

bool is_non_temporal(const CrowdJob& job, std::size_t bytes) noexcept {
    return job.stores == Stores::non_temporal ||
           (job.stores == Stores::automatic && bytes >= non_temporal_threshold);
}

/// Deforms the whole instances [first, last), many at a time.
GOFFER_OWN_FRAME CrowdResult run_lanes(const Batch& batch, const CrowdJob& job, std::size_t first,
                                       std::size_t last, bool non_temporal) noexcept {
    const Activity active(batch, job.frame);
    CrowdResult result;
    for (const bool wrinkled : {true, false}) {
        if (!wrinkled && batch.wrinkle_weights.empty()) continue;
        LaneRunner runner(batch, kernels(job.isa), non_temporal, wrinkled);
        for (std::size_t i = first; i < last; ++i) {
            if (!active[i]) continue;
            const bool wrinkles = weight_at(batch.wrinkle_weights, element_of(batch, i)) > 0;
            if (wrinkles == wrinkled) runner.add(i);
        }
        runner.finish();
        result += runner.result();
    }
    return result;
}

/// The same with previous positions, which are the positions of a batch that is now where this one was. The
/// gaps of one of the two may hold values of the other: no gap is scratch.
CrowdResult run_lanes_twice(const Batch& batch, const CrowdJob& job, std::size_t first, std::size_t last,
                            bool non_temporal) noexcept {
    Batch now = batch;
    now.previous_positions = {};
    assert(!now.scratch_gaps && "see LaneRunner::suits");
    Batch before = now;
    before.poses = batch.previous_poses;
    before.transforms = batch.previous_transforms;
    before.positions = batch.previous_positions;
    before.normals = {};
    before.tangents = {};
    run_lanes(before, job, first, last, non_temporal);
    return run_lanes(now, job, first, last, non_temporal);
}

/// Deforms a batch from one of its places to another, one instance at a time.
GOFFER_OWN_FRAME CrowdResult run_one_by_one(const Batch& batch, const CrowdJob& job, Place from, Place to,
                                            bool non_temporal) noexcept {
    const Activity active(batch, job.frame);
    const std::size_t vertices = batch.body->vertex_count(), row = row_of(batch);
    BatchRunner runner(batch, kernels(job.isa), non_temporal);
    const auto run_instances = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (active[i]) runner.add(i);
        }
    };
    const auto run_part_of_row = [&](std::size_t begin, std::size_t first, std::size_t last) {
        runner.set_part(first, last);
        run_instances(begin, std::min(begin + row, batch.count));
    };
    std::size_t begin = from.instance;
    if (from.vertex != 0) {
        run_part_of_row(begin, from.vertex, begin == to.instance ? to.vertex : vertices);
        begin += row;
    }
    runner.set_part(0, vertices);
    run_instances(begin, to.instance);
    if (to.vertex != 0 && begin <= to.instance) run_part_of_row(to.instance, 0, to.vertex);
    runner.finish();
    return runner.result();
}

/// Deforms a batch from one of its places to another.
CrowdResult run_batch(const Batch& batch, const CrowdJob& job, Place from, Place to,
                      bool non_temporal) noexcept {
    const std::size_t first = from.instance + (from.vertex != 0 ? row_of(batch) : 0);
    const std::size_t whole = to.instance - std::min(first, to.instance);
    if (!LaneRunner::suits(batch, whole, kernels(job.isa)))
        return run_one_by_one(batch, job, from, to, non_temporal);
    CrowdResult result;
    if (from.vertex != 0) result += run_one_by_one(batch, job, from, {from.batch, first, 0}, non_temporal);
    const auto run_whole = batch.previous_positions.empty() ? run_lanes : run_lanes_twice;
    result += run_whole(batch, job, first, to.instance, non_temporal);
    if (to.vertex != 0) result += run_one_by_one(batch, job, {to.batch, to.instance, 0}, to, non_temporal);
    return result;
}

CrowdResult run_between(const CrowdJob& job, Place from, Place to, bool non_temporal) noexcept {
    CrowdResult result;
    for (std::size_t b = from.batch; b < job.batches.size() && b <= to.batch; ++b) {
        const Batch& batch = job.batches[b];
        const Place begin = b == from.batch ? from : Place{b, 0, 0};
        const Place end = b == to.batch ? to : Place{b, batch.count, 0};
        if (begin.instance < end.instance || begin.vertex < end.vertex)
            result += run_batch(batch, job, begin, end, non_temporal);
    }
    if (non_temporal) simd::fence();
    return result;
}

/// Finds where pieces begin. They must be asked for in order.
class Cutter {
public:
    /// `vertices`: those of all instances that are not skipped.
    Cutter(const CrowdJob& job, std::size_t vertices, std::size_t pieces) noexcept
        : job_(job), vertices_(vertices), pieces_(pieces) {}

    [[nodiscard]] Place begin_of(std::size_t piece) noexcept {
        const Place end = {job_.batches.size(), 0, 0};
        if (piece == pieces_) return end;
        // What is left over goes to the first pieces, one vertex each: vertices_ * piece might overflow.
        const std::size_t wanted = vertices_ / pieces_ * piece + std::min(vertices_ % pieces_, piece);
        for (; place_.batch < job_.batches.size(); place_ = {place_.batch + 1, 0, 0}) {
            if (found(wanted)) return place_;
        }
        return end;
    }

private:
    /// Whether the vertex `wanted` lies in this batch. Looks from the place found last, and leaves the place
    /// there.
    bool found(std::size_t wanted) noexcept {
        const Batch& batch = job_.batches[place_.batch];
        const Activity active(batch, job_.frame);
        const std::size_t size = batch.body->vertex_count(), row = row_of(batch);
        place_.vertex = 0;
        if (active.all() && size != 0) {
            const std::size_t rows = std::min((wanted - before_) / size, batch.count - place_.instance) / row;
            place_.instance += rows * row;
            before_ += rows * row * size;
        }
        for (; place_.instance < batch.count; place_.instance += row) {
            const std::size_t end = std::min(place_.instance + row, batch.count);
            const std::size_t together = active.count(place_.instance, end);
            if (wanted - before_ < together * size) {
                // A multiple of a line: no line is cut, if the instances begin one.
                place_.vertex = (wanted - before_) / together / line_floats * line_floats;
                return true;
            }
            before_ += together * size;
        }
        return false;
    }

    const CrowdJob& job_;
    std::size_t vertices_, pieces_;
    Place place_;
    std::size_t before_ = 0;  // active vertices before place_.instance
};

}  // namespace

Batch batch_of(const DeformJob& job) noexcept {
    const auto poses = [](std::span<const Pose> many, const Pose& one) {
        if (many.empty()) many = {&one, 1};
        return StridedView<Pose>{
            .data = many.data(), .count = 1, .stride = static_cast<std::uint32_t>(many.size_bytes())};
    };
    const auto transform = [](const glm::mat4x3& matrix) {
        return TransformColumn(StridedView<glm::mat4x3>{.data = &matrix, .count = 1});
    };
    Batch batch;
    batch.body = job.body;
    batch.count = 1;
    batch.poses = poses(job.poses, job.pose);
    batch.transforms = transform(job.transform);
    batch.wrinkle_weights = {.data = &job.wrinkle_weight, .count = 1};
    batch.previous_poses = poses(job.previous_poses, job.previous_pose);
    batch.previous_transforms = transform(job.previous_transform);
    batch.positions = job.positions;
    batch.normals = job.normals;
    batch.tangents = job.tangents;
    batch.packed = job.packed;
    batch.previous_positions = job.previous_positions;
    if (job.bounds != nullptr) batch.bounds = {job.bounds, 1};
    batch.scratch_gaps = job.scratch_gaps;
    return batch;
}

glm::mat4x3 TransformColumn::operator[](std::size_t index) const noexcept {
    const float* from = first.at(index);
    const MatrixSteps steps = steps_of(layout);
    glm::mat4x3 matrix;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) matrix[c][r] = from[c * steps.column + r * steps.row];
    }
    return matrix;
}

Fault validate(const CrowdJob& job) noexcept {
    for (std::size_t b = 0; b < job.batches.size(); ++b) {
        Fault fault = check(job.batches[b]);
        fault.batch = b;
        if (!fault.none()) return fault;
    }
    return runs_here(job.isa) ? Fault{} : Fault{.field = Field::isa, .reason = Reason::not_supported};
}

CrowdResult run(const CrowdJob& job) noexcept {
    assert(may_run(job));
    return run_between(job, {}, {job.batches.size(), 0, 0}, is_non_temporal(job, size_of(job).bytes));
}

CrowdResult run_piece(const CrowdJob& job, std::size_t piece, std::size_t pieces) noexcept {
    assert(piece < pieces && may_run(job));
    const Size size = size_of(job);
    Cutter cutter(job, size.vertices, pieces);
    const Place from = cutter.begin_of(piece);
    return run_between(job, from, cutter.begin_of(piece + 1), is_non_temporal(job, size.bytes));
}

CrowdResult run_parallel(const CrowdJob& job) {
    assert(may_run(job));
    const Size size = size_of(job);
    const bool non_temporal = is_non_temporal(job, size.bytes);
    const std::size_t pieces = std::clamp<std::size_t>(size.vertices / min_vertices, 1, max_pieces);
    Place places[max_pieces + 1];
    Cutter cutter(job, size.vertices, pieces);
    for (std::size_t piece = 0; piece <= pieces; ++piece) places[piece] = cutter.begin_of(piece);
    std::atomic<std::size_t> deformed = 0, clamped = 0, at_rest = 0;
    parallel_ranges(pieces, 1, [&](std::size_t first, std::size_t last) {
        const CrowdResult part = run_between(job, places[first], places[last], non_temporal);
        deformed.fetch_add(part.deformed, std::memory_order_relaxed);
        clamped.fetch_add(part.clamped, std::memory_order_relaxed);
        at_rest.fetch_add(part.at_rest, std::memory_order_relaxed);
    });
    return {deformed.load(), clamped.load(), at_rest.load()};
}

}  // namespace goffer::bend
