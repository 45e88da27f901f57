// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/engine/strided_view.hpp>

#include <glm/fwd.hpp>
#include <glm/mat4x3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

/// The crowd: a frame's worth of instances in one call, as columns that the engine keeps anyway.
///
///     struct Worm { bend::Pose pose; glm::mat4 model; };
///     std::vector<Worm> worms;  // or components, in whatever pools
///     bend::Batch batch{.body = &body, .count = worms.size()};
///     batch.poses = strided(std::span(worms), &Worm::pose);
///     batch.transforms = strided(std::span(worms), &Worm::model);
///     batch.positions = interleaved<3>(&vertices[0].x, vertices.size(), sizeof(Vertex));
///     batch.vertex_step = body.vertex_count();  // instance i begins at vertex i * vertex_step
///     const bend::CrowdResult result = bend::run_parallel({.batches = {&batch, 1}});
///
/// Nothing is gathered first, and nothing is kept between frames. An instance gets the same bits as from
/// run() for it alone, whatever its place in a batch, the split into pieces or the number of threads.

namespace goffer::bend {

/// A column of affine transforms, one per instance, in one of the layouts that engines use. A plain value
/// that owns nothing.
struct TransformColumn {
    /// How the matrix that takes column vectors to the outputs' space lies in memory. A matrix that takes row
    /// vectors, with the translation in its last row, as DirectXMath has it, lies like columns4.
    enum class MatrixLayout : std::uint8_t {
        columns3,  ///< four columns of 3 floats: glm::mat4x3
        columns4,  ///< four columns of 4 floats: glm::mat4; the fourth of each is not read
        rows4,     ///< three rows of 4 floats: the usual instance buffer of a GPU
    };

    StridedView<float> first;  ///< the first float of each matrix, which the others follow
    MatrixLayout layout = MatrixLayout::columns3;

    /// Not given: the identity for all instances.
    TransformColumn() = default;
    TransformColumn(StridedView<float> view, MatrixLayout how) : first(view), layout(how) {}
    TransformColumn(const StridedView<glm::mat4x3>& view) : first(floats(view)) {}
    /// From glm::mat4; include glm/mat4x4.hpp for it.
    template <glm::qualifier Q>
    TransformColumn(const StridedView<glm::mat<4, 4, float, Q>>& view)
        : first(floats(view)), layout(MatrixLayout::columns4) {}

    [[nodiscard]] bool empty() const noexcept { return first.empty(); }
    /// Matrix `index` < first.count, from whatever layout.
    [[nodiscard]] glm::mat4x3 operator[](std::size_t index) const noexcept;

private:
    template <class Matrix>
    [[nodiscard]] static StridedView<float> floats(const StridedView<Matrix>& view) noexcept {
        return {view.data, view.count, view.stride, view.offset, view.page_shift};
    }
};

/// Instances of one body. A plain value; everything that it points to is the caller's and must outlive the
/// run.
///
/// Instance i reads element i of each column, or element indices[i]. A column that is not given has the
/// default named beside it. A batch of 0 instances needs a body alone. As for a job, at least one stream must
/// be given, outputs are never read, and no two of them may share a byte: neither two streams, nor two
/// instances, nor an output and an input.
struct Batch {
    const Body* body = nullptr;  ///< neither null nor empty
    std::size_t count = 0;       ///< instances
    /// Empty, or one per instance: the element that it reads, in pools that other bodies' instances share.
    std::span<const std::uint32_t> indices = {};

    /// Must be given. An element is the first of an instance's region_count() poses, from base to tip, and
    /// the others follow it in memory. They may be an array in a struct: Pose[n], of n regions or more. They
    /// may be one plain array, n for each instance: the stride is then n * sizeof(Pose), and `count` the
    /// number of instances. The stride is at least region_count() poses, or 0: the same for all.
    StridedView<Pose> poses = {};
    TransformColumn transforms = {};           ///< as DeformJob::transform; default: the identity
    StridedView<float> wrinkle_weights = {};   ///< as DeformJob::wrinkle_weight; default: 1
    StridedView<Pose> previous_poses = {};     ///< as `poses`; must be given with previous_positions
    TransformColumn previous_transforms = {};  ///< likewise; default: the identity, not `transforms`

    /// 0: the instance is not seen in this frame and is skipped (see bounds()). Default: 1.
    StridedView<std::uint8_t> visible = {};
    /// 0: pose and outputs of the instance are still those of the last run, and it is skipped. Default: 1.
    StridedView<std::uint8_t> changed = {};
    /// n > 1: the instance is skipped unless (CrowdJob::frame + i) mod n is 0, with i its place in the batch:
    /// spreads the work on instances far away over frames. One that has just come into view needs 1, or its
    /// outputs are old. 0 counts as 1. Default: 1.
    StridedView<std::uint8_t> update_intervals = {};

    /// Where vertices go: streams as in DeformJob, over a buffer that holds the vertices of all instances.
    /// The `count` of a stream is that of the whole buffer.
    Stream3 positions = {};
    Stream3 normals = {};
    Stream4 tangents = {};
    PackedStream packed = {};
    Stream3 previous_positions = {};
    /// Empty, or one per instance i, whatever `indices` says, which a run sets unless it skips the instance.
    /// They cost from half a microsecond each, which with few vertices may be more than these do.
    std::span<Bounds> bounds = {};
    /// A column, as above: the first vertex of an instance in the buffer. Default: i * vertex_step.
    StridedView<std::uint32_t> vertex_offsets = {};
    /// From one instance's first vertex to the next one's; at least the body's vertex_count(). Not read where
    /// vertex_offsets are given.
    std::size_t vertex_step = 0;

    /// Bytes of a record between and after its outputs, up to the next record, are left as they are: they
    /// may hold data of the caller's. Set this where they do not: past the cache most records of up to 64
    /// bytes may then be written as whole lines, with zeros in the gaps, which takes 0.7 to 0.95 of the time
    /// for bodies of a thousand vertices, but up to 1.5 times as long for bodies of fifty. Gaps are kept all
    /// the same in the cache, and where a batch writes several sets of records with one stride. With it set,
    /// vertices that vertex_step leaves between two instances may be overwritten too, with any bits, up to
    /// the end of a cache line: nothing else may lie there, no other batch's instances either. What lies
    /// before the first instance and after the last one, or around instances with vertex_offsets, stays
    /// untouched.
    bool scratch_gaps = false;
};

/// Makes a batch of one from `job`. The batch refers to `job`, which must outlive it and stay where it is,
/// and so may not be a temporary. job.isa is lost: CrowdJob::isa takes its place. Does not allocate.
/// Thread-safe.
[[nodiscard]] Batch batch_of(const DeformJob& job) noexcept;
Batch batch_of(const DeformJob&&) = delete;

/// How results leave the processor.
enum class Stores : std::uint8_t {
    /// Past the cache where the crowd writes non_temporal_threshold bytes or more, else into it.
    automatic,
    /// Into the cache: this processor reads the results soon.
    cached,
    /// Past the cache, whole lines at a time: the GPU reads the results, or nobody does for a while. Has an
    /// effect on x86-64 with vector kernels. What cannot be written as whole lines is cached all the same:
    /// records whose gaps are kept, and long records with gaps.
    non_temporal,
};

/// Bytes of streams, gaps not counted, from which on Stores::automatic means non_temporal. A fixed number:
/// the size of the caches is not looked up.
inline constexpr std::size_t non_temporal_threshold = std::size_t{16} << 20;

/// A crowd. A plain value; everything that it points to is the caller's and must outlive the run.
struct CrowdJob {
    std::span<const Batch> batches = {};
    std::uint32_t frame = 0;  ///< number of the frame, which update_intervals are counted by
    Stores stores = Stores::automatic;
    Isa isa = Isa::automatic;  ///< kernels to use
};

/// Finds the first fault of `job`. Looks at every instance, whatever its masks say, and at every index and
/// vertex offset: a job that validated once stays in bounds in later frames, whatever their masks, frame
/// numbers, weights, transforms and poses, as long as no count changes. Does not find out whether instances
/// overlap that vertex_offsets place, whether two batches write to the same memory, or whether an input
/// shares bytes with an output. Of the pages of a column it finds only those that are null or not aligned.
/// Does not allocate. Thread-safe.
[[nodiscard]] Fault validate(const CrowdJob& job) noexcept;

/// What a run did.
struct CrowdResult {
    std::size_t deformed = 0;  ///< instances that were not skipped
    /// Those among them whose `poses` were finite, and had an angle beyond a region's max_angle.
    std::size_t clamped = 0;
    std::size_t at_rest = 0;  ///< those among them whose `poses` were not finite: taken as at rest

    /// Adds the result of another piece.
    CrowdResult& operator+=(const CrowdResult& other) noexcept {
        deformed += other.deformed;
        clamped += other.clamped;
        at_rest += other.at_rest;
        return *this;
    }
    [[nodiscard]] bool operator==(const CrowdResult& other) const noexcept = default;
};

/// Deforms all instances that are not skipped, on the calling thread. `job` must validate, except for its
/// poses, weights and transforms, which may hold any bits: angles are clamped, poses that are not finite are
/// taken as at rest, weights beyond 0..1 as the nearer of these and NaN as 0, and transforms that are not
/// finite give infinities, and NaNs of any bits. Allocates and logs nothing, and locks in the first run of a
/// process alone; takes up to 64 KB of stack. Thread-safe where outputs do not overlap.
///
/// On one machine and with one build, the bits of the result depend on `job` and its isa alone: not on the
/// split, the number of threads, an instance's neighbors or `stores`.
CrowdResult run(const CrowdJob& job) noexcept;

/// The same with oneTBB in the caller's arena (GOFFER_TBB=OFF: on the calling thread). The work is split by
/// vertices, so that a few large bodies spread as well as many small ones. The same bits. goffer allocates
/// nothing; the scheduler's own pools fill in the first frames.
CrowdResult run_parallel(const CrowdJob& job);

/// Deforms piece `piece` < `pieces` on the calling thread, for schedulers other than oneTBB: call it once for
/// each piece, in any order, from any threads, also at the same time. Pieces have about the same number of
/// vertices; an instance may be cut between several. The same bits, and the results of all pieces add up to
/// that of run(). Each call looks through all batches and their masks to find its piece, so use tens of
/// pieces, not thousands.
CrowdResult run_piece(const CrowdJob& job, std::size_t piece, std::size_t pieces) noexcept;

}  // namespace goffer::bend
