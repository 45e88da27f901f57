// SPDX-License-Identifier: MIT
#include <goffer/engine/parallel.hpp>

/// Takes the place of parallel.cpp in a build without oneTBB.

namespace goffer {

void parallel_ranges(std::size_t count, std::size_t /*grain*/, void* context,
                     void (*body)(void* context, std::size_t first, std::size_t last)) {
    if (count != 0) body(context, 0, count);
}

}  // namespace goffer
