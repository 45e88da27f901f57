// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "measure.hpp"
#include "naive.hpp"

#include <vector>

namespace goffer::bench {
namespace {

constexpr std::size_t naive_vertices = 10'000;
constexpr double direction = 0.3;

void naive(benchmark::State& state, bool with_normals) {
    NaiveBody body = make_naive(naive_vertices);
    double angle = 0.5;
    set_amplitudes(body, angle, direction);
    std::vector<NaivePoint> positions(naive_vertices);
    std::vector<NaivePoint> normals(naive_vertices);
    Task task;
    task.prepare = [&] { angle = angle > 1.5 ? 0.5 : angle + 0.01; };
    task.work = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            if (with_normals) {
                deform_naive(body, angle, direction, positions, normals);
            } else {
                deform_naive(body, angle, direction, positions);
            }
            benchmark::ClobberMemory();
        }
    };
    report(state, measure(state, task), naive_vertices);
}

}  // namespace

void register_naive() {
    benchmark::RegisterBenchmark("naive/positions", naive, false);
    benchmark::RegisterBenchmark("naive/positions+normals", naive, true);
}

}  // namespace goffer::bench
