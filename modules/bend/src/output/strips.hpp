// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"
#include "output/output_plan.hpp"

#include <cstddef>

namespace goffer::bend {

/// Records that are put together in the first-level cache, by as many passes as it takes, and then written as
/// whole lines: a strip for each record of a plan that is written in lines.
class Strips {
public:
    static constexpr std::size_t most_vertices = 64;   // few: their lines leave while the next are made
    static constexpr std::size_t most_floats = 2080;   // of all strips
    static constexpr std::size_t longest_record = 32;  // floats; of longer ones most lines would be gaps

    /// Floats that a strip takes.
    [[nodiscard]] static constexpr std::size_t floats_of(std::size_t record_floats) noexcept {
        return line_floats + most_vertices * record_floats;
    }

    Strips() noexcept;

    /// For `count` <= most_vertices records from vertex `vertex` of the caller's buffer on. As much of the
    /// first line as lies before them is left free, so that lines here are lines there.
    void begin(const OutputPlan& plan, std::size_t vertex) noexcept;

    /// Where the value of record `record` that is `offset` floats behind its strip's first one is.
    [[nodiscard]] float* at(const OutputPlan& plan, std::size_t record, std::size_t offset) noexcept {
        Block& block = blocks_[current_];
        return block.values + plan.records()[record].strip + block.before[record] + offset;
    }

    /// Writes `count` records of each out, to where begin() was told. `ends`: with the last of them the
    /// instance ends, behind which no gap may be written.
    ///
    /// Not at once, but when the next block is complete: narrow stores must have left the processor's queue
    /// before they can be read as wide values, and in that queue they wait for the lines before them.
    void write(const OutputPlan& plan, const KernelSet& kernels, std::size_t count, bool ends) noexcept;

    /// Writes what is left.
    void flush(const OutputPlan& plan, const KernelSet& kernels) noexcept;

private:
    static constexpr std::size_t nowhere = line_floats;

    struct Block {
        std::size_t vertex = 0;  // of the caller's buffer
        std::size_t count = 0;   // 0: nothing to be written
        bool ends = false;
        std::size_t before[most_values];  // floats of the first line before the first record
        alignas(64) float values[most_floats];
    };

    static void write_out(Block& block, const OutputPlan& plan, const KernelSet& kernels) noexcept;

    Block blocks_[2];
    std::size_t current_ = 0;
};

}  // namespace goffer::bend
