// SPDX-License-Identifier: MIT
#include "crowd_threads.hpp"

namespace ecs {

using namespace goffer;

CrowdThreads::CrowdThreads(std::size_t count)
    : results_(count), begin_(static_cast<std::ptrdiff_t>(count)), end_(static_cast<std::ptrdiff_t>(count)) {
    others_.reserve(count - 1);
    for (std::size_t thread = 1; thread < count; ++thread) {
        others_.emplace_back([this, thread] {
            for (;;) {
                begin_.arrive_and_wait();
                if (crowd_ == nullptr) return;
                run_pieces(thread);
                end_.arrive_and_wait();
            }
        });
    }
}

CrowdThreads::~CrowdThreads() {
    crowd_ = nullptr;
    begin_.arrive_and_wait();
    for (std::thread& thread : others_) thread.join();
}

bend::CrowdResult CrowdThreads::run(const bend::CrowdJob& crowd) {
    crowd_ = &crowd;
    begin_.arrive_and_wait();
    run_pieces(0);
    end_.arrive_and_wait();
    bend::CrowdResult sum;
    for (const bend::CrowdResult& result : results_) sum += result;
    return sum;
}

void CrowdThreads::run_pieces(std::size_t thread) {
    const std::size_t pieces = 4 * results_.size();  // several per thread balance the load
    results_[thread] = {};
    for (std::size_t piece = thread; piece < pieces; piece += results_.size())
        results_[thread] += bend::run_piece(*crowd_, piece, pieces);
}

}  // namespace ecs
