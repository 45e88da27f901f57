// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "output/output_plan.hpp"

#include <cstddef>

namespace goffer::bend {

/// Buffers in the first-level cache where passes assemble records, one strip for each Record with in_strip.
/// The records are then written as whole cache lines.
class Strips {
public:
    static constexpr std::size_t max_vertices = 64;    // few, so that lines leave while the next are computed
    static constexpr std::size_t max_floats = 2080;    // in all strips together
    static constexpr std::size_t longest_record = 32;  // floats; longer ones would be gaps for the most part

    /// The number of floats that a strip takes.
    [[nodiscard]] static constexpr std::size_t floats_of(std::size_t record_floats) noexcept {
        return line_floats + max_vertices * record_floats;
    }

    Strips() noexcept;

    /// Begins a block of at most max_vertices records, from vertex `vertex` of the caller's buffer on.
    /// Leaves as much of the first line free as lies before them there, so that lines here are lines there.
    void begin(const OutputPlan& plan, std::size_t vertex) noexcept;

    /// The address of the float `offset` floats behind the first value of record `record` in this block.
    [[nodiscard]] float* at(const OutputPlan& plan, std::size_t record, std::size_t offset) noexcept {
        Block& block = blocks_[current_];
        return block.values + plan.records()[record].strip + block.before[record] + offset;
    }

    /// Ends the block and writes its first `count` records of each strip. `ends`: the last of them is the
    /// last of the instance, and the gap behind it must not be written.
    ///
    /// They are not written at once, but when the next block is complete. Narrow stores must leave the
    /// processor's store queue before they can be read as wide values, and in that queue they wait for the
    /// lines before them.
    void write(const OutputPlan& plan, const KernelSet& kernels, std::size_t count, bool ends) noexcept;

    /// Writes the block that is left.
    void flush(const OutputPlan& plan, const KernelSet& kernels) noexcept;

private:
    static constexpr std::size_t nowhere = line_floats;

    struct Block {
        std::size_t vertex = 0;  // in the caller's buffer
        std::size_t count = 0;   // 0: nothing to write
        bool ends = false;
        std::size_t before[max_values];  // floats of the first line before the first record
        alignas(64) float values[max_floats];
    };

    static void write_out(Block& block, const OutputPlan& plan, const KernelSet& kernels) noexcept;

    Block blocks_[2];
    std::size_t current_ = 0;
};

}  // namespace goffer::bend
