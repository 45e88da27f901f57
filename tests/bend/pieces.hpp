// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

#include <cstddef>
#include <thread>
#include <vector>

/// Crowds that are run in pieces.

namespace goffer::test {

inline void add(bend::CrowdResult& sum, const bend::CrowdResult& part) {
    sum.deformed += part.deformed;
    sum.clamped += part.clamped;
    sum.at_rest += part.at_rest;
}

/// Every `step`-th of `pieces` pieces, from `first` on.
inline bend::CrowdResult run_pieces(const bend::CrowdJob& job, std::size_t first, std::size_t step,
                                    std::size_t pieces) {
    bend::CrowdResult sum;
    for (std::size_t piece = first; piece < pieces; piece += step)
        add(sum, bend::run_piece(job, piece, pieces));
    return sum;
}

/// Pieces dealt out to threads of the caller.
inline bend::CrowdResult run_on_threads(const bend::CrowdJob& job, std::size_t threads, std::size_t pieces) {
    std::vector<bend::CrowdResult> results(threads);
    std::vector<std::thread> workers;
    for (std::size_t i = 0; i < threads; ++i)
        workers.emplace_back([&, i] { results[i] = run_pieces(job, i, threads, pieces); });
    bend::CrowdResult sum;
    for (std::size_t i = 0; i < threads; ++i) {
        workers[i].join();
        add(sum, results[i]);
    }
    return sum;
}

}  // namespace goffer::test
