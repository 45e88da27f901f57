// SPDX-License-Identifier: MIT
#include "fixture.hpp"

#include <thread>

namespace goffer::bench {

const bend::Body& Fixture::body(std::size_t vertices, Shape shape) {
    const std::pair key(vertices, shape);
    const auto found = bodies_.find(key);
    if (found != bodies_.end()) return found->second;
    return bodies_.emplace(key, make_body(vertices, shape)).first->second;
}

std::span<float> Fixture::memory(std::size_t floats) {
    if (memory_.columns() == 0 || memory_.count() < floats) {
        memory_ = Columns();  // first back, then anew: never both
        memory_ = Columns(1, floats);
    }
    return memory_[0].first(floats);
}

std::vector<int> Fixture::thread_counts() {
    const int all = static_cast<int>(std::thread::hardware_concurrency());
    if (all < 2) return {1};
    if (all == 2) return {1, 2};
    return {1, 2, all};
}

}  // namespace goffer::bench
