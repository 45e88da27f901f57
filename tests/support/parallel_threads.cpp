// SPDX-License-Identifier: MIT
#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <thread>
#include <vector>

/// The engine's loop on plain threads, for the thread sanitizer: oneTBB is not built for it, and races are
/// reported that are none. A program that has this file is linked with it instead of the engine's own.

namespace goffer {

void parallel_ranges(std::size_t count, std::size_t grain, void* context,
                     void (*body)(void* context, std::size_t first, std::size_t last)) {
    constexpr std::size_t most = 4;
    const std::size_t parts = std::clamp<std::size_t>(count / std::max<std::size_t>(grain, 1), 1, most);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < parts; ++i) {
        const std::size_t first = i * count / parts, last = (i + 1) * count / parts;
        if (first != last) threads.emplace_back(body, context, first, last);
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace goffer
