// SPDX-License-Identifier: MIT
#include "floor.hpp"

#include "cases.hpp"
#include "measure.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/measure/fill.hpp>

#include <string>

namespace goffer::bench {
namespace {

constexpr std::size_t crowd_vertices = 1000 * 10'000;
constexpr std::size_t cache_vertices = 10'000;
constexpr std::size_t floats = 3;

std::function<void(std::size_t)> filling(std::span<float> to, bool non_temporal, int threads) {
    return [=](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            measure::fill(to, static_cast<float>(i), non_temporal, threads);
            benchmark::ClobberMemory();
        }
    };
}

std::function<void(std::size_t)> copying(std::span<const float> from, std::span<float> to, bool non_temporal,
                                         int threads) {
    return [=](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            measure::copy(from, to, non_temporal, threads);
            benchmark::ClobberMemory();
        }
    };
}

/// One half of the memory is copied to the other and back: all of it is read and written once.
std::function<void(std::size_t)> swapping(std::span<float> memory, bool non_temporal, int threads) {
    const std::span<float> low = memory.first(memory.size() / 2), high = memory.subspan(low.size());
    return [=](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            measure::copy(low, high, non_temporal, threads);
            measure::copy(high.first(low.size()), low, non_temporal, threads);
            benchmark::ClobberMemory();
        }
    };
}

enum class Kind { fill, fill_nt, copy, copy_nt, fill_cache };

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
            return copying(memory.last(crowd.size()), crowd, false, threads);
        case Kind::copy_nt:
            return copying(memory.last(crowd.size()), crowd, true, threads);
        case Kind::fill_cache:
            return filling(crowd.first(cache_vertices * floats), false, threads);
    }
    return {};
}

void run_case(benchmark::State& state, Fixture& fixture, Kind kind, int threads) {
    const std::size_t vertices = kind == Kind::fill_cache ? cache_vertices : crowd_vertices;
    const std::span<float> memory = fixture.memory(2 * crowd_vertices * floats);
    const Task task{.batch = batch_for(vertices), .threads = threads, .work = work_of(kind, memory, threads)};
    fixture.with_threads(
        threads, [&] { report(state, measure(state, task), vertices, vertices * floats * sizeof(float)); });
}

}  // namespace

std::function<void(std::size_t)> floor_of(Fixture& fixture, const measure::StreamLayout& layout,
                                          std::size_t vertices, int threads) {
    const std::span<float> memory = fixture.memory(vertices * layout.footprint());
    const bool non_temporal = memory.size_bytes() >= bend::non_temporal_threshold;
    return layout.keeps_gaps() ? swapping(memory, non_temporal, threads)
                               : filling(memory, non_temporal, threads);
}

void register_floor(Fixture& fixture) {
    const FloorCase cases[] = {{"fill", Kind::fill},
                               {"fill_nt", Kind::fill_nt},
                               {"copy", Kind::copy},
                               {"copy_nt", Kind::copy_nt},
                               {"fill_cache", Kind::fill_cache}};
    for (const FloorCase& floor : cases) {
        for (const int threads : Fixture::thread_counts()) {
            const std::string name = "floor/" + floor.name + "/" + std::to_string(threads);
            benchmark::RegisterBenchmark(name.c_str(), run_case, std::ref(fixture), floor.kind, threads);
        }
    }
}

}  // namespace goffer::bench
