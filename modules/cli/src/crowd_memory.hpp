// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/columns.hpp>

#include <cstddef>
#include <cstdint>

namespace goffer::cli {

/// How the vertices of a crowd lie in memory.
enum class StreamLayout : std::uint8_t {
    planar,       ///< a plane each of all x, all y, all z, and of the normals' three
    interleaved,  ///< records without gaps: three floats of position, and three of normal
    packed,       ///< records of 12 bytes, which hold normals too (bend::PackedVertex)
};

/// The memory that a crowd is deformed into: one instance behind the other, without gaps, in one block that
/// starts on a cache line (as every plane does). Touched when it is made.
class CrowdMemory {
public:
    /// For `vertices` of all instances together. Throws std::bad_alloc.
    CrowdMemory(StreamLayout layout, bool normals, std::size_t vertices);

    /// Bytes that a vertex takes.
    [[nodiscard]] static std::size_t vertex_bytes(StreamLayout layout, bool normals) noexcept;

    /// Points the streams of `batch` to the vertices of its instances, the first of which is vertex `first`
    /// of the crowd.
    void point(bend::Batch& batch, std::size_t first) noexcept;

    /// Bytes that a frame writes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return values_.columns() * values_.count() * sizeof(float);
    }

    /// Fills all of it past the cache with what `seed` makes (goffer::fill): the least that a frame can cost.
    /// `parallel`: with oneTBB, in the caller's arena.
    void fill(float seed, bool parallel);

    /// 64 bits of all bytes, in their order.
    [[nodiscard]] std::uint64_t hash() const noexcept;

private:
    StreamLayout layout_;
    bool normals_;
    Columns values_;  // the planes; otherwise one column, whatever its values are
};

}  // namespace goffer::cli
