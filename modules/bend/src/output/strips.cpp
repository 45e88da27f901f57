// SPDX-License-Identifier: MIT
#include "output/strips.hpp"

#include "kernel/lines.hpp"

#include <algorithm>

namespace goffer::bend {

Strips::Strips() noexcept {
    for (Block& block : blocks_) std::ranges::fill(block.before, nowhere);
}

void Strips::begin(const OutputPlan& plan, std::size_t vertex) noexcept {
    Block& block = blocks_[current_];
    block.vertex = vertex;
    for (std::size_t r = 0; r < plan.records().size(); ++r) {
        const Record& record = plan.records()[r];
        if (!record.in_strip) continue;
        const float* const to = record.first + vertex * record.stride_floats();
        const std::size_t before = (line_floats - floats_to_line<Strips>(to)) % line_floats;
        // Gaps hold zeros, which stay valid while blocks begin at the same place of a line.
        if (record.has_gaps() && before != block.before[r])
            std::fill_n(block.values + record.strip, floats_of(record.stride_floats()), 0.0f);
        block.before[r] = before;
    }
}

void Strips::write(const OutputPlan& plan, const KernelSet& kernels, std::size_t count, bool ends) noexcept {
    blocks_[current_].count = count;
    blocks_[current_].ends = ends;
    current_ = 1 - current_;
    write_out(blocks_[current_], plan, kernels);
}

void Strips::flush(const OutputPlan& plan, const KernelSet& kernels) noexcept {
    write_out(blocks_[1 - current_], plan, kernels);
}

void Strips::write_out(Block& block, const OutputPlan& plan, const KernelSet& kernels) noexcept {
    if (block.count == 0) return;
    for (std::size_t r = 0; r < plan.records().size(); ++r) {
        const Record& record = plan.records()[r];
        if (!record.in_strip) continue;
        const std::size_t floats = record.stride_floats();
        const std::size_t behind = block.ends ? floats - record.floats : 0;
        kernels.copy_lines(block.values + record.strip + block.before[r],
                           record.first + block.vertex * floats, block.count * floats - behind, true);
    }
    block.count = 0;
}

}  // namespace goffer::bend
