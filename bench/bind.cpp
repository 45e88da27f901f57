// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "measure.hpp"
#include "model.hpp"

#include <string>

namespace goffer::bench {
namespace {

void bind(benchmark::State& state, std::size_t vertices) {
    const Model model(vertices);
    const Task task{.work = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const bend::Body body = bind_model(model);
            benchmark::DoNotOptimize(body.vertex_count());
        }
    }};
    report(state, measure(state, task), vertices);
}

}  // namespace

void register_bind() {
    for (const std::size_t vertices : {1'000, 10'000, 100'000}) {
        benchmark::RegisterBenchmark(("bind/" + std::to_string(vertices)).c_str(), bind, vertices)
            ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace goffer::bench
