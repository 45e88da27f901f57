// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/engine/columns.hpp>

#include <tbb/task_arena.h>

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace goffer::bench {

/// What cases share, made when first asked for: the bodies, the memory that they are deformed into, the
/// threads. Cases run one after the other, so none of it is guarded.
class Fixture {
public:
    /// The body of so many vertices.
    [[nodiscard]] const bend::Body& body(std::size_t vertices, Shape shape = Shape::plain);

    /// Memory for `floats` floats, on a cache line, its pages touched. The same memory for every case: a
    /// crowd's page faults are paid once, not in every case. Grows, never shrinks; what it holds is whatever
    /// the last case left.
    [[nodiscard]] std::span<float> memory(std::size_t floats);

    /// Calls `work` from within an arena of `threads` threads.
    template <class Work>
    void with_threads(int threads, Work&& work) {
        arenas_.try_emplace(threads, threads).first->second.execute(std::forward<Work>(work));
    }

    /// The numbers of threads to measure with: 1, 2 and all that the machine has.
    [[nodiscard]] static std::vector<int> thread_counts();

private:
    std::map<std::pair<std::size_t, Shape>, bend::Body> bodies_;
    std::map<int, tbb::task_arena> arenas_;
    Columns memory_;
};

}  // namespace goffer::bench
