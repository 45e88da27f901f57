// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "output/output_plan.hpp"

#include <cstddef>
#include <span>

namespace goffer::bend {

/// Planes of one instance's vertices, of all values of a plan, to be written to the caller's buffer.
class StagedPlanes {
public:
    /// `stride`: floats from one plane to the next, at most max_stride.
    StagedPlanes(const float* first, std::size_t stride) noexcept : planes_(first), stride_(stride) {}

    /// Writes the first `count` vertices, from vertex `vertex` of the buffer on: the values of passes in the
    /// mode `mode`. `ends`: the last of them is the last of the instance, and the gap behind it must not be
    /// written.
    void write(const OutputPlan& plan, const KernelSet& kernels, WriteMode mode, std::size_t vertex,
               std::size_t count, bool ends) const noexcept;

    static constexpr std::size_t max_stride = 320;

private:
    /// Writes all of them, and leaves gaps as they are.
    void write_rows(const Record& record, std::span<const Component> components, const KernelSet& kernels,
                    std::size_t vertex, std::size_t count) const noexcept;
    /// Writes the vertices [first, last), value by value.
    void write_values(const Record& record, std::span<const Component> components, std::size_t vertex,
                      std::size_t first, std::size_t last) const noexcept;
    /// Writes all of them, and zeros into gaps, but for those before the first and behind the last.
    void weave(const Record& record, std::span<const Component> components, const KernelSet& kernels,
               std::size_t vertex, std::size_t count, bool ends) const noexcept;

    const float* planes_;
    std::size_t stride_;
};

/// A block of one instance's vertices as planes in the first-level cache. Kernels write it where they cannot
/// write the outputs themselves: planes that cannot be written side by side, lines that two regions share
/// and vertices near their joint, records of several passes or with gaps, components in another order.
class StagingBuffer {
public:
    /// Has a plane for each value of the plan.
    explicit StagingBuffer(const OutputPlan& plan) noexcept;
    StagingBuffer(const StagingBuffer&) = delete;
    StagingBuffer& operator=(const StagingBuffer&) = delete;

    /// The number of vertices that it holds: a multiple of a cache line.
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

    /// The planes of a pass, for a kernel to fill. The plan has it, and stages something.
    [[nodiscard]] const PlaneOutput& output(Pass pass) const noexcept {
        return outputs_[static_cast<std::size_t>(pass)];
    }

    [[nodiscard]] StagedPlanes planes() const noexcept { return {planes_, stride_}; }

private:
    [[nodiscard]] PlaneOutput output_of(const PassPlan& pass) noexcept;

    static constexpr std::size_t max_floats = 3328;  // 160 vertices of 16 values, with what they spare
    static constexpr std::size_t max_vertices = 256;
    // For the whole units that kernels write, and so that planes begin at different places of the cache.
    static constexpr std::size_t spare = max_unit + line_floats;
    static_assert(max_floats / max_values > spare + 2 * line_floats);
    static_assert(max_vertices + spare <= StagedPlanes::max_stride);

    std::size_t capacity_;
    std::size_t stride_;               // floats from one plane to the next
    PlaneOutput outputs_[pass_count];  // set where output() may be asked for them
    alignas(64) float planes_[max_floats];
};

}  // namespace goffer::bend
