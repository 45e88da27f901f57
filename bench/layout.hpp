// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <span>
#include <string_view>

/// The streams that cases write, and where in a crowd's memory each instance's are.

namespace goffer::bench {

/// A set of streams. The name is the <streams> of a case.
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
    [[nodiscard]] std::size_t footprint() const { return record != 0 ? record : floats; }
    /// Whether records have gaps that must stay as they are.
    [[nodiscard]] bool keeps_gaps() const { return footprint() != floats && !scratch; }
};

/// All of them.
[[nodiscard]] std::span<const StreamLayout> layouts();

/// The one of that name, which must be there.
[[nodiscard]] const StreamLayout& layout(std::string_view name);

/// Vertices that memory for `vertices` is made for: planes are longer than that, so that they lie as the
/// layout says. Where planes are a page's multiple apart, lines on their way to memory get into each other's
/// way.
[[nodiscard]] std::size_t capacity_for(const StreamLayout& layout, std::size_t vertices);

/// The memory of a crowd: `capacity` vertices in `values`, which holds capacity * footprint() floats.
struct CrowdMemory {
    float* values = nullptr;
    std::size_t capacity = 0;
};

/// Sets the streams of `job`, whose first vertex is vertex `first` of the crowd's memory.
void set_streams(bend::DeformJob& job, const StreamLayout& layout, const CrowdMemory& memory,
                 std::size_t first);

/// Sets those of a batch: over all of the crowd's memory.
void set_streams(bend::Batch& batch, const StreamLayout& layout, const CrowdMemory& memory);

}  // namespace goffer::bench
