// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// What validate() finds: which field of a job or of a crowd is wrong, where, and why.

namespace goffer::bend {

/// The field at fault, by its name in DeformJob or Batch.
enum class Field : std::uint8_t {
    none,
    body,
    poses,  ///< `pose`, of a job without `poses`
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

/// What is wrong with it.
enum class Reason : std::uint8_t {
    none,
    null,        ///< a body that is not given; a component of a stream that is null beside others that aren't
    empty,       ///< a body that was moved from or never made; a crowd or a job that writes nothing
    not_finite,  ///< a NaN or an infinity
    too_large,   ///< a transform with a number beyond 1e18
    out_of_range,  ///< a weight outside 0..1, an index beyond a column, an angle beyond what a float can turn
                   ///< by
    count,         ///< not as many as there are regions, or instances
    too_short,     ///< a stream that ends before the last vertex
    stride,        ///< no multiple of 4, or less than what one vertex takes
    alignment,     ///< not aligned to its type
    overlap,       ///< two streams write to the same bytes
    not_supported,  ///< tangents of a body without; an instruction set that this machine or this build lacks
};

/// A fault. A plain value; a default-made one is none.
struct Fault {
    static constexpr std::size_t nowhere = ~std::size_t{0};

    Field field = Field::none;
    Reason reason = Reason::none;
    std::size_t batch = nowhere;     ///< index in CrowdJob::batches; nowhere: of a single job
    std::size_t instance = nowhere;  ///< in its batch; nowhere: the same for all instances
    std::size_t region = nowhere;    ///< of a pose
    Field other = Field::none;       ///< of an overlap: the other stream

    [[nodiscard]] bool none() const noexcept { return reason == Reason::none; }
};

/// One line of text that owns its characters, so that making it does not allocate.
struct FaultText {
    char text[256] = {};

    [[nodiscard]] const char* c_str() const noexcept { return text; }
    [[nodiscard]] operator std::string_view() const noexcept { return text; }
};

/// `fault` in words: what, where, and what it should be, as in "batches[1].poses[7][2]: not finite; ...".
/// "no fault" for none. Does not allocate. Thread-safe.
[[nodiscard]] FaultText describe(const Fault& fault) noexcept;

}  // namespace goffer::bend
