// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/engine/strided_view.hpp>

#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

/// The crowd: a frame's worth of instances in one call, as columns that the engine keeps anyway.
///
///     struct Worm { bend::Pose pose; glm::mat4 model; };  // components, in whatever pools
///     bend::Batch batch{.body = &body, .count = worms.size()};
///     batch.poses = strided(std::span(worms), &Worm::pose);
///     batch.transforms = strided(std::span(worms), &Worm::model);
///     batch.positions = interleaved<3>(&vertices[0].x, vertices.size(), sizeof(Vertex));
///     batch.vertex_step = body.vertex_count();  // instance i begins at vertex i * vertex_step
///     const bend::CrowdResult result = bend::run_parallel({.batches = {&batch, 1}});
///
/// Nothing is gathered and nothing is kept between frames. The order of instances in a batch has no bearing
/// on speed or bits: an instance's bits are those of run() for it alone.

namespace goffer::bend {

/// A column of affine transforms, one per instance, in one of the layouts that engines use.
struct TransformColumn {
    /// How the twelve numbers lie. All are of the matrix that takes column vectors to the outputs' space.
    enum class MatrixLayout : std::uint8_t {
        columns3,  ///< four columns of 3 floats: glm::mat4x3
        columns4,  ///< four columns of 4 floats, the fourth not read: glm::mat4
        rows4,     ///< three rows of 4 floats: the usual buffer of instances on a GPU
    };

    StridedView<float> first;  ///< each matrix's first float; the others follow it
    MatrixLayout layout = MatrixLayout::columns3;

    TransformColumn() = default;  ///< not given: the identity for all
    TransformColumn(StridedView<float> view, MatrixLayout how) : first(view), layout(how) {}
    TransformColumn(const StridedView<glm::mat4x3>& view) : first(floats(view)) {}
    TransformColumn(const StridedView<glm::mat4>& view)
        : first(floats(view)), layout(MatrixLayout::columns4) {}

    [[nodiscard]] bool empty() const noexcept { return first.empty(); }
    [[nodiscard]] glm::mat4x3 operator[](std::size_t index) const noexcept;

private:
    template <class Matrix>
    [[nodiscard]] static StridedView<float> floats(const StridedView<Matrix>& view) noexcept {
        return {view.data, view.count, view.stride, view.offset, view.page_shift};
    }
};

/// Instances of one body. A plain value; everything it points to is the caller's and must outlive the run.
///
/// Instance i reads element i of each column, or element indices[i]. Columns that are not given stand for
/// what is said beside them. As for a job, outputs are never read, and no two of them may share a byte.
struct Batch {
    const Body* body = nullptr;
    std::size_t count = 0;  ///< instances
    /// Empty, or one per instance: where its elements are, in pools that hold other bodies' instances too.
    std::span<const std::uint32_t> indices = {};

    StridedView<Pose> poses = {};     ///< the first region's; those of the others follow it. Must be given
    TransformColumn transforms = {};  ///< as DeformJob::transform
    StridedView<float> wrinkle_weights = {};  ///< as DeformJob::wrinkle_weight; not given: 1
    StridedView<Pose> previous_poses = {};    ///< as `poses`; must be given with previous_positions
    TransformColumn previous_transforms = {};
    StridedView<std::uint8_t> visible =
        {};  ///< 0: not seen in this frame, nothing is done for it (see bounds())
    StridedView<std::uint8_t> changed =
        {};  ///< 0: its pose and outputs are as they were, nothing is done for it
    /// n > 1: done only in frames in which (CrowdJob::frame + i) mod n is 0, so that the work on instances
    /// that are far away is spread over frames. 0 stands for 1.
    StridedView<std::uint8_t> update_intervals = {};

    /// Where vertices go: streams over a buffer of all instances' vertices, as in DeformJob. A stream's
    /// `count` is that of the whole buffer.
    Stream3 positions = {};
    Stream3 normals = {};
    Stream4 tangents = {};
    PackedStream packed = {};
    Stream3 previous_positions = {};
    std::span<Bounds> bounds = {};  ///< empty, or one per instance i, where a run leaves its bounds
    /// The first vertex of instance i is vertex_offsets[i] (or [indices[i]]), or i * vertex_step where no
    /// offsets are given.
    StridedView<std::uint32_t> vertex_offsets = {};
    std::size_t vertex_step = 0;
    bool scratch_gaps = false;  ///< as DeformJob::scratch_gaps
};

/// What a batch's optional columns hold of each instance, beside its pose and its transform.
inline constexpr std::size_t instance_bytes =
    2 * sizeof(std::uint32_t) + sizeof(float) + 3 * sizeof(std::uint8_t);
static_assert(instance_bytes <= 32);

/// `job` as a batch of one, which reads from `job` itself: it must outlive the batch, and not move. Its isa
/// is CrowdJob's to say.
[[nodiscard]] Batch batch_of(const DeformJob& job) noexcept;

/// How results leave the processor.
enum class Stores : std::uint8_t {
    automatic,     ///< past the cache where the whole crowd's output is larger than the cache, else into it
    cached,        ///< into the cache: the next reader is this processor, soon
    non_temporal,  ///< past the cache, whole lines at a time: the next reader is the GPU, or nobody for a
                   ///< while. What can't be written as whole lines (records with gaps that are not scratch)
                   ///< is cached all the same.
};

/// Output bytes from which on Stores::automatic is non-temporal.
inline constexpr std::size_t non_temporal_threshold = std::size_t{16} << 20;

/// A crowd. A plain value; everything it points to is the caller's.
struct CrowdJob {
    std::span<const Batch> batches = {};
    std::uint32_t frame = 0;  ///< number of the frame: read where there are update_intervals
    Stores stores = Stores::automatic;
    Isa isa = Isa::automatic;  ///< kernels to use
};

/// The first fault of `job`, or none; of every instance, whatever its masks say, so that what validates once
/// is safe in later frames with other masks, frame numbers, weights, transforms and poses. Columns that say
/// where to read or write (indices, vertex_offsets) are looked through. Does not allocate. Thread-safe.
[[nodiscard]] Fault validate(const CrowdJob& job) noexcept;

/// What a run did.
struct CrowdResult {
    std::size_t deformed = 0;  ///< instances that were visible and changed, and had their turn
    std::size_t clamped = 0;   ///< of these, instances with an angle beyond their body's, which was clamped
    std::size_t at_rest = 0;   ///< of these, instances with a pose that is not finite, taken as at rest

    /// Adds the result of another piece.
    CrowdResult& operator+=(const CrowdResult& other) noexcept {
        deformed += other.deformed;
        clamped += other.clamped;
        at_rest += other.at_rest;
        return *this;
    }
    [[nodiscard]] bool operator==(const CrowdResult& other) const noexcept = default;
};

/// Deforms all visible, changed instances on the calling thread. `job` must validate, but for its poses and
/// weights, which may hold any bits. Does not allocate, lock or log; takes up to 68 KB of stack. Thread-safe
/// where outputs do not overlap.
CrowdResult run(const CrowdJob& job) noexcept;

/// The same with oneTBB in the caller's arena (GOFFER_TBB=OFF: on the calling thread), split by vertices: a
/// few large bodies and many small ones spread alike. The same bits. goffer allocates nothing; the
/// scheduler's own pools fill in the first frames.
CrowdResult run_parallel(const CrowdJob& job);

/// Deforms piece `piece` of `pieces`, piece < pieces, on the calling thread: what any scheduler can call,
/// each piece once, in any order, from any thread. Pieces are about equal in vertices; an instance may lie in
/// several. Finding a piece takes a look at every batch, and at every mask: some tens of pieces are enough.
/// The same bits; the results of all pieces add up to those of run().
CrowdResult run_piece(const CrowdJob& job, std::size_t piece, std::size_t pieces) noexcept;

}  // namespace goffer::bend
