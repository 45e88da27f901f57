// SPDX-License-Identifier: MIT
#include "floor.hpp"

#include "cases.hpp"
#include "measure.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/engine/fill.hpp>
#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <cstring>
#include <string>

namespace goffer::bench {
namespace {

constexpr std::size_t crowd_vertices = 1000 * 10'000;
constexpr std::size_t cache_vertices = 10'000;
constexpr std::size_t floats = 3;

/// Calls `part` for all of [0, count): at once, or in ranges of whole lines for the threads to share.
template <class Part>
void share(std::size_t count, int threads, const Part& part) {
    if (threads == 1) {
        part(0, count);
        return;
    }
    constexpr std::size_t line = column_alignment / sizeof(float);
    constexpr std::size_t most = 16384;  // lines of a range: a megabyte
    const std::size_t lines = (count + line - 1) / line;
    const std::size_t grain = std::clamp<std::size_t>(lines / static_cast<std::size_t>(threads), 1, most);
    parallel_ranges(lines, grain, [&](std::size_t first, std::size_t last) {
        part(first * line, std::min(last * line, count));
    });
}

void fill_shared(std::span<float> to, float value, bool streaming, int threads) {
    share(to.size(), threads, [&](std::size_t first, std::size_t last) {
        fill(to.subspan(first, last - first), value, streaming);
    });
}

void copy_shared(std::span<const float> from, std::span<float> to, int threads) {
    share(to.size(), threads, [&](std::size_t first, std::size_t last) {
        std::memcpy(&to[first], &from[first], (last - first) * sizeof(float));
    });
}

std::function<void(std::size_t)> filling(std::span<float> to, bool streaming, int threads) {
    return [=](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            fill_shared(to, static_cast<float>(i), streaming, threads);
            benchmark::ClobberMemory();
        }
    };
}

std::function<void(std::size_t)> copying(std::span<const float> from, std::span<float> to, int threads) {
    return [=](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            copy_shared(from, to, threads);
            benchmark::ClobberMemory();
        }
    };
}

enum class Kind { fill, fill_nt, copy, fill_cache };

struct FloorCase {
    std::string name;
    Kind kind;
};

std::function<void(std::size_t)> work_of(Kind kind, std::span<float> memory, int threads) {
    const std::span<float> crowd = memory.first(crowd_vertices * floats);
    switch (kind) {
        case Kind::fill:
            return filling(crowd, false, threads);
        case Kind::fill_nt:
            return filling(crowd, true, threads);
        case Kind::copy:
            return copying(memory.last(crowd.size()), crowd, threads);
        case Kind::fill_cache:
            return filling(crowd.first(cache_vertices * floats), false, threads);
    }
    return {};
}

void run_case(benchmark::State& state, Stage& stage, Kind kind, int threads) {
    const std::size_t vertices = kind == Kind::fill_cache ? cache_vertices : crowd_vertices;
    const std::span<float> memory = stage.memory(2 * crowd_vertices * floats);
    const Task task{.batch = batch_for(vertices), .threads = threads, .work = work_of(kind, memory, threads)};
    stage.with_threads(
        threads, [&] { report(state, measure(state, task), vertices, vertices * floats * sizeof(float)); });
}

}  // namespace

std::function<void(std::size_t)> floor_of(Stage& stage, std::size_t count, int threads) {
    const bool streaming = count * sizeof(float) >= bend::streaming_threshold;
    return filling(stage.memory(count), streaming, threads);
}

void register_floor(Stage& stage) {
    const FloorCase cases[] = {{"fill", Kind::fill},
                               {"fill_nt", Kind::fill_nt},
                               {"copy", Kind::copy},
                               {"fill_cache", Kind::fill_cache}};
    for (const FloorCase& floor : cases) {
        for (const int threads : Stage::thread_counts()) {
            const std::string name = "floor/" + floor.name + "/" + std::to_string(threads);
            benchmark::RegisterBenchmark(name.c_str(), run_case, std::ref(stage), floor.kind, threads);
        }
    }
}

}  // namespace goffer::bench
