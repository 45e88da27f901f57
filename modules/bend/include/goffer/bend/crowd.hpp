// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// The crowd: a frame's worth of instances, any mix of bodies and poses, in one call.
///
///     std::vector<bend::DeformJob> jobs = ...;  // kept from frame to frame; each frame sets the poses
///     const bend::CrowdResult result = bend::run_parallel(bend::CrowdJob{.instances = jobs});
///
/// Neighbours in the span that share a body are deformed together, block by block, while the body's columns
/// are in the first-level cache: keep instances sorted by body.

namespace goffer::bend {

/// How results leave the processor.
enum class Stores : std::uint8_t {
    automatic,  ///< past the cache when the whole crowd's output is larger than the cache, else into it
    cached,     ///< into the cache: the next reader is this processor, soon
    streaming,  ///< past the cache, whole lines at a time: the next reader is the GPU, or nobody for a while.
                ///< Only where whole lines are written: planes that are equally aligned, or records
                ///< without gaps. What else there is is cached all the same.
};

/// Output bytes from which on `Stores::automatic` streams.
inline constexpr std::size_t streaming_threshold = std::size_t{16} << 20;

/// A crowd. A plain value; everything it points to is the caller's.
struct CrowdJob {
    std::span<const DeformJob> instances;  ///< outputs must not overlap
    /// Empty: all; else one per instance. 0: not seen in this frame, nothing is done for it. (See bounds().)
    std::span<const std::uint8_t> visible = {};
    /// Empty: all; else one per instance. 0: its pose and its outputs are as they were, nothing is done for
    /// it.
    std::span<const std::uint8_t> changed = {};
    /// Empty: all in every frame; else one per instance: n >= 1 deforms instance i in every n-th frame only,
    /// those in which (frame + i) mod n is 0, so that the work is spread over frames; 0 is taken as 1. In
    /// other frames its outputs stay as they are. For instances that are far away.
    std::span<const std::uint8_t> every = {};
    std::uint32_t frame = 0;  ///< number of the frame: read where there is an `every`
    Stores stores = Stores::automatic;
};

/// What is wrong with a crowd.
struct CrowdFault {
    JobFault fault = JobFault::none;  ///< of the instance named below
    std::size_t instance = 0;         ///< index of the first instance at fault
    bool visible_count = false;       ///< `visible` is neither empty nor one per instance
    bool changed_count = false;       ///< `changed` likewise
    bool every_count = false;         ///< `every` likewise

    [[nodiscard]] bool none() const noexcept {
        return fault == JobFault::none && !visible_count && !changed_count && !every_count;
    }
};

/// One line on `fault`, in static storage; of an instance's fault, what describe(fault.fault) says.
/// Thread-safe.
[[nodiscard]] std::string_view describe(const CrowdFault& fault) noexcept;

/// The first fault of `job`. A crowd without fault cannot make a run read or write out of bounds. Does not
/// allocate. Thread-safe.
[[nodiscard]] CrowdFault validate(const CrowdJob& job) noexcept;

/// What a run did.
struct CrowdResult {
    std::size_t deformed = 0;  ///< instances that were visible and changed, and had their turn
    std::size_t clamped = 0;   ///< of these, instances whose angle was beyond their body's and was clamped
};

/// Deforms all visible, changed instances on the calling thread. `job` must validate. Does not allocate, lock
/// or log. Thread-safe where outputs do not overlap. The bits are those of run() for each instance.
CrowdResult run(const CrowdJob& job) noexcept;

/// The same with oneTBB in the caller's arena (GOFFER_TBB=OFF: on the calling thread), split by vertices: a
/// few large bodies and many small ones spread alike. The same bits. goffer allocates nothing; the
/// scheduler's own pools fill in the first frames.
CrowdResult run_parallel(const CrowdJob& job);

/// Deforms piece `piece` of `pieces`, piece < pieces, on the calling thread: what any scheduler can call,
/// each piece once, in any order, from any thread. Pieces are about equal in vertices; an instance may lie in
/// several. Finding a piece takes a look at every instance: some tens of pieces are enough. The same bits;
/// the results of all pieces add up to those of run().
CrowdResult run_piece(const CrowdJob& job, std::size_t piece, std::size_t pieces) noexcept;

}  // namespace goffer::bend
