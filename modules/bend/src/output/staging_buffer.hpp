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
    /// `zeros` is a plane of zeros, if a record of the plan is woven and has gaps.
    StagedPlanes(const float* first, std::size_t stride, const float* zeros) noexcept
        : planes_(first), stride_(stride), zeros_(zeros) {}

    /// Writes the first `count` vertices, from vertex `vertex` of the buffer on: the values of passes in the
    /// mode `mode`. `ends`: the last of them is the last of the instance, and the gap behind it must not be
    /// written.
    void write(const OutputPlan& plan, const KernelSet& kernels, WriteMode mode, std::size_t vertex,
               std::size_t count, bool ends) const noexcept;
    /// The same for the values of all passes.
    void write(const OutputPlan& plan, const KernelSet& kernels, std::size_t vertex, std::size_t count,
               bool ends) const noexcept;

private:
    void write(const Record& record, const OutputPlan& plan, const KernelSet& kernels, std::size_t vertex,
               std::size_t count, bool ends) const noexcept;
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
    std::size_t stride_;  // floats from one plane to the next
    const float* zeros_;
};

/// Whether a record of the plan is woven and has gaps, which are written as zeros.
[[nodiscard]] bool weaves_gaps(const OutputPlan& plan) noexcept;

/// A block of one instance's vertices as planes in the first-level cache. Kernels write it where they cannot
/// write the outputs themselves: planes that cannot be written side by side, lines that two regions share,
/// records of several passes or with gaps, components in another order.
class StagingBuffer {
public:
    /// Has a plane for each value of the plan.
    explicit StagingBuffer(const OutputPlan& plan) noexcept;
    StagingBuffer(const StagingBuffer&) = delete;
    StagingBuffer& operator=(const StagingBuffer&) = delete;

    /// The number of vertices that it holds: a multiple of a cache line.
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

    /// The planes of a pass from the block's vertex `vertex` on, for a kernel to fill.
    [[nodiscard]] PlaneOutput output(const PassPlan& pass, std::size_t vertex) noexcept;

    [[nodiscard]] StagedPlanes planes() const noexcept { return {planes_, stride_, zeros_}; }

private:
    static constexpr std::size_t max_floats = 3392;
    static constexpr std::size_t max_vertices = 256;
    // For the whole units that kernels write, and so that planes begin at different places of the cache.
    static constexpr std::size_t spare = max_unit + line_floats;
    static_assert(max_floats / (max_values + 1) > spare + 2 * line_floats);

    std::size_t capacity_;
    std::size_t stride_;  // floats from one plane to the next
    const float* zeros_;  // a plane of zeros, behind those of values
    alignas(64) float planes_[max_floats];
};

}  // namespace goffer::bend
