// SPDX-License-Identifier: MIT
#include "support/arena.hpp"

#include <tbb/task_arena.h>

namespace goffer::test {

void in_arena(int threads, const std::function<void()>& work) {
    tbb::task_arena arena(threads);
    arena.execute(work);
}

}  // namespace goffer::test
