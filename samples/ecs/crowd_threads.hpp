// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

#include <barrier>
#include <cstddef>
#include <thread>
#include <vector>

namespace ecs {

/// Threads that deform a crowd together: stands for an engine's own job system.
class CrowdThreads {
public:
    /// `count` >= 1, the caller's among them.
    explicit CrowdThreads(std::size_t count);
    CrowdThreads(const CrowdThreads&) = delete;
    CrowdThreads& operator=(const CrowdThreads&) = delete;
    ~CrowdThreads();

    /// Does not allocate.
    goffer::bend::CrowdResult run(const goffer::bend::CrowdJob& crowd);

private:
    void run_pieces(std::size_t thread);

    std::vector<goffer::bend::CrowdResult> results_;  // of each thread
    std::barrier<> begin_, end_;
    const goffer::bend::CrowdJob* crowd_ = nullptr;  // null: the threads end
    std::vector<std::thread> others_;
};

}  // namespace ecs
