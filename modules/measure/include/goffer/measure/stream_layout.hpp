// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <span>
#include <string_view>

/// The streams that a crowd is deformed into, and where in a block of memory each vertex's values are.

namespace goffer::measure {

/// A set of streams and how they lie. The name is what benchmarks call it.
struct StreamLayout {
    std::string_view name;
    std::size_t floats = 3;  ///< written per vertex, in units of 4 bytes
    std::size_t record = 0;  ///< floats from one vertex to the next; 0: planes, each over the whole crowd
    bool normals = false;
    bool tangents = false;
    bool previous = false;  ///< positions at the previous pose as well
    bool paged = false;     ///< planes a multiple of 4096 bytes apart; else none is
    bool packed = false;    ///< bend::PackedVertex, and nothing else
    bool scratch = false;   ///< what lies in the gaps of records may be written over

    /// Floats of memory per vertex: with the gaps.
    [[nodiscard]] std::size_t footprint() const noexcept { return record != 0 ? record : floats; }
    /// Whether records have gaps that must stay as they are.
    [[nodiscard]] bool keeps_gaps() const noexcept { return footprint() != floats && !scratch; }
    /// Floats of memory to make for `vertices`: planes are longer than that, so that they lie as the layout
    /// says, and each begins on a cache line if the memory does. (Where planes are a page's multiple apart,
    /// lines on their way to memory get into each other's way.)
    [[nodiscard]] std::size_t memory_floats(std::size_t vertices) const noexcept;
};

/// Returns all of them. Thread-safe.
[[nodiscard]] std::span<const StreamLayout> stream_layouts() noexcept;

/// Returns the one of that name, which must be there. Thread-safe.
[[nodiscard]] const StreamLayout& stream_layout(std::string_view name) noexcept;

/// Sets the streams of `job` or `batch` to `count` vertices from vertex `first` of `memory` on, all of which
/// is in `layout`: memory_floats() of it. Planes are as far apart as it allows. Thread-safe.
void set_streams(bend::DeformJob& job, const StreamLayout& layout, std::span<float> memory, std::size_t first,
                 std::size_t count) noexcept;
void set_streams(bend::Batch& batch, const StreamLayout& layout, std::span<float> memory, std::size_t first,
                 std::size_t count) noexcept;

}  // namespace goffer::measure
