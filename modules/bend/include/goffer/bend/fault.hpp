// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// What validate() finds: which field of a job or a crowd is wrong, where, and why.

namespace goffer::bend {

/// The field at fault, by its name in DeformJob, or in Batch where that alone has it.
enum class Field : std::uint8_t {
    none,
    body,
    poses,  ///< `pose` in a job without `poses`
    transform,
    wrinkle_weight,
    positions,
    normals,
    tangents,
    packed,
    bounds,
    previous_positions,
    previous_poses,
    previous_transform,
    outputs,  ///< all streams together
    vertex_offsets,
    vertex_step,
    indices,
    visible,
    changed,
    update_intervals,
    isa,
};

/// What is wrong with it. Shared with BodyFault.
enum class Reason : std::uint8_t {
    none,
    null,        ///< a body or poses not given; a component of a stream null, though others are not; a page
    empty,       ///< a body moved from or never made; nothing to write; no vertices; no regions
    not_finite,  ///< a NaN or an infinity
    too_large,   ///< a transform with a number beyond 1e18
    /// Outside 0..1 (a weight), WorkingRange (a body's number), its column (an index) or a stream (a vertex
    /// offset); memory that would end beyond all addresses (a stream); a value that a layout or a page's size
    /// does not have; or, of a body, what its field does not allow: axes that are no rotation, vertices in
    /// another order than a blend asks for, a blend without a table or without a next region.
    out_of_range,
    /// Not as many as there are regions, instances or vertices; a table of one row; more than max_regions.
    count,
    too_short,      ///< a stream that ends before the last vertex
    stride,         ///< no multiple of 4, or less than one vertex takes; of a column, less than is read
    alignment,      ///< not aligned to its type, or a stride that is no multiple of that
    overlap,        ///< two streams or instances may write to the same bytes
    not_supported,  ///< tangents of a body without any; an instruction set that cannot run here
};

/// The first fault of a job or a crowd. A plain value; a default-constructed one is none.
struct Fault {
    static constexpr std::size_t nowhere = ~std::size_t{0};

    Field field = Field::none;
    Reason reason = Reason::none;
    std::size_t batch = nowhere;     ///< index in CrowdJob::batches; `nowhere` for a single job
    std::size_t instance = nowhere;  ///< index in its batch; `nowhere` if no one instance is at fault
    std::size_t region = nowhere;    ///< region of the pose at fault
    Field other = Field::none;       ///< the other stream of an overlap
    std::size_t has = nowhere;       ///< how many elements there are, or the step, where that is the fault,
    std::size_t needs = nowhere;     ///< and how many it takes at least; else, or beyond all numbers, nowhere

    [[nodiscard]] bool none() const noexcept { return reason == Reason::none; }
};

/// One line of text, ended by a 0, that owns its characters: making it does not allocate.
struct FaultText {
    char text[256] = {};

    [[nodiscard]] const char* c_str() const noexcept { return text; }
    [[nodiscard]] operator std::string_view() const noexcept { return text; }
};

/// Says in one line what is wrong and where, as in "batches[1].poses[7][2]: not finite: a NaN or an
/// infinity", with counts where they are at fault, and with the names of DeformJob or, of a crowd, of Batch.
/// Returns "no fault" if there is none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const Fault& fault) noexcept;

}  // namespace goffer::bend
