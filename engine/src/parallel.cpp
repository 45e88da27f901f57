// SPDX-License-Identifier: MIT
#include <goffer/engine/parallel.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace goffer {

void parallel_ranges(std::size_t count, std::size_t grain, void* context,
                     void (*body)(void* context, std::size_t first, std::size_t last)) {
    if (count == 0) return;
    if (grain == 0) grain = 1;
    if (count <= grain) {
        body(context, 0, count);
        return;
    }
    const tbb::blocked_range<std::size_t> range(0, count, grain);
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(range, [&](const tbb::blocked_range<std::size_t>& part) {
            body(context, part.begin(), part.end());
        });
    });
}

}  // namespace goffer
