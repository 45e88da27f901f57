// SPDX-License-Identifier: MIT
#pragma once

#include "pose/instance.hpp"
#include "kernel/kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace goffer::bend {

/// A stream's place in memory, whatever it holds: `floats` planes or components.
struct Output {
    float* component[4] = {};
    std::size_t stride = 0;
    std::size_t floats = 0;  // 3; 4 for tangents

    /// Components lie one behind the other, as in a record.
    [[nodiscard]] bool record() const noexcept;
};

/// What one pass writes, and the kernels that make it. Which outputs are wanted is in their `floats`.
struct Outputs {
    Output positions, normals, tangents;
    Kernel planes = nullptr;   ///< may make more streams than are wanted, if not `exact`
    Kernel records = nullptr;  ///< null where there is none
    bool exact = true;         ///< `planes` makes what is wanted and nothing else

    /// Whether all of it is planes, as `planes` writes them.
    [[nodiscard]] bool planar() const noexcept;
    /// Whether all of it is records without gaps, as `records` writes them.
    [[nodiscard]] bool dense() const noexcept;
    /// Whether planes can be written past the cache side by side: they begin their cache lines at the same
    /// vertices, and do not compete for the same places of the first-level cache, as planes do that lie a
    /// multiple of a kilobyte apart (2 to 4 times as long as one plane after the other).
    [[nodiscard]] bool side_by_side() const noexcept;
    /// Of planes that are equally aligned, or of dense records: how many vertices from `first` on lie before
    /// the first cache line that begins with a vertex; line_floats where none does.
    [[nodiscard]] std::size_t head(std::size_t first) const noexcept;
};

[[nodiscard]] Outputs outputs_of(const PreparedPass& pass, const KernelSet& set) noexcept;

/// The planes of a block of vertices, written out as records and planes of the caller's.
class RecordWriter {
public:
    static constexpr std::size_t most_vertices = 256;  // whole lines; and the head of the first of them
    static constexpr std::size_t plane_stride = most_vertices + line_floats;

    RecordWriter(const Outputs& outputs, const KernelSet& set) noexcept;

    /// The block's plane for component `c` of the positions, normals or tangents.
    [[nodiscard]] float* position(std::size_t c) noexcept { return plane(first_plane_[0] + c); }
    [[nodiscard]] float* normal(std::size_t c) noexcept { return plane(first_plane_[1] + c); }
    [[nodiscard]] float* tangent(std::size_t c) noexcept { return plane(first_plane_[2] + c); }

    /// How many vertices from `first` on make the first block, so that later blocks begin on whole lines.
    [[nodiscard]] std::size_t first_block(std::size_t first, bool streaming) const noexcept;

    /// Writes `count` vertices of the block, which are the caller's vertices from `first` on.
    void write(std::size_t first, std::size_t count, bool streaming) const noexcept;

private:
    /// Streams that lie one behind the other in the same records; or one plane.
    struct Record {
        Output out;
        std::size_t plane;   // of the first component
        std::size_t floats;  // of all
    };

    [[nodiscard]] float* plane(std::size_t index) noexcept { return planes_ + index * plane_stride; }
    [[nodiscard]] const float* plane(std::size_t index) const noexcept {
        return planes_ + index * plane_stride;
    }
    [[nodiscard]] bool dense(const Record& record) const noexcept;
    void write(const Record& record, std::size_t first, std::size_t count, bool streaming) const noexcept;

    alignas(64) float planes_[10 * plane_stride + 4];  // the last rows are read in fours
    Record records_[10];
    std::size_t record_count_ = 0;
    std::size_t first_plane_[3] = {};
    const KernelSet& set_;
};

}  // namespace goffer::bend
