// SPDX-License-Identifier: MIT
#include "ratios.hpp"
#include "subject.hpp"

#include <goffer/bend/crowd.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// One body of 10,000 vertices, one thread, in cache: goffer's kernels beside the naive code and beside a
/// fill of the bytes that they write. The angle changes with every iteration, so that nothing of a pose is
/// kept.

namespace goffer::bench {
namespace {

constexpr std::size_t vertices = 10000;

float next_angle(float angle) {
    return angle > 1.5f ? 0.5f : angle + 0.01f;
}

void count_vertices(benchmark::State& state, std::size_t per_iteration) {
    const auto total = static_cast<double>(state.iterations()) * static_cast<double>(per_iteration) * 1e-9;
    state.counters["ns_per_vertex"] =
        benchmark::Counter(total, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

struct Output {
    std::vector<float> values;
    std::size_t count;

    Output(std::size_t vertex_count, std::size_t floats)
        : values(vertex_count * floats), count(vertex_count) {}

    [[nodiscard]] std::span<float> column(std::size_t index) {
        return std::span(values).subspan(index * count, count);
    }
};

void deform(benchmark::State& state, const bend::Body& body, Isa isa, bool normals) {
    Output out(body.vertex_count(), normals ? 6 : 3);
    bend::DeformJob job;
    job.body = &body;
    job.isa = isa;
    job.pose = {.angle = 0.5f, .direction = 0.3f};
    job.positions = planar(out.column(0), out.column(1), out.column(2));
    if (normals) job.normals = planar(out.column(3), out.column(4), out.column(5));
    if (const bend::JobFault fault = bend::validate(job); fault != bend::JobFault::none) {
        state.SkipWithError(std::string(bend::describe(fault)).c_str());
        return;
    }
    for (auto _ : state) {
        job.pose.angle = next_angle(job.pose.angle);
        bend::run(job);
        benchmark::ClobberMemory();
    }
    count_vertices(state, body.vertex_count());
}

/// A thousand instances of one body, whose output is larger than any cache.
void deform_crowd(benchmark::State& state, const bend::Body& body, Isa isa, bool normals, bool parallel) {
    constexpr std::size_t instances = 1000;
    const std::size_t count = body.vertex_count();
    Columns out(normals ? 6 : 3, instances * count);
    std::vector<bend::DeformJob> jobs(instances);
    for (std::size_t i = 0; i < instances; ++i) {
        const auto column = [&](std::size_t c) { return out[c].subspan(i * count, count); };
        jobs[i].body = &body;
        jobs[i].isa = isa;
        jobs[i].positions = planar(column(0), column(1), column(2));
        if (normals) jobs[i].normals = planar(column(3), column(4), column(5));
    }
    const bend::CrowdJob crowd{.instances = jobs};
    float phase = 0;
    for (auto _ : state) {
        phase += 0.01f;
        for (std::size_t i = 0; i < instances; ++i) {
            jobs[i].pose = {1.0f + 0.5f * std::sin(phase + static_cast<float>(i)), static_cast<float>(i)};
        }
        parallel ? bend::run_parallel(crowd) : bend::run(crowd);
        benchmark::ClobberMemory();
    }
    count_vertices(state, instances * count);
}

void naive(benchmark::State& state, bool normals) {
    NaiveBody body = make_naive(vertices);
    double angle = 0.5;
    set_amplitudes(body, angle, 0.3);
    std::vector<NaivePoint> positions(body.vertices.size());
    std::vector<NaivePoint> directions(body.vertices.size());
    for (auto _ : state) {
        angle = static_cast<double>(next_angle(static_cast<float>(angle)));
        if (normals) {
            deform_naive(body, angle, 0.3, positions, directions);
        } else {
            deform_naive(body, angle, 0.3, positions);
        }
        benchmark::ClobberMemory();
    }
    count_vertices(state, body.vertices.size());
}

void fill(benchmark::State& state, std::size_t floats) {
    Output out(vertices, floats);
    float value = 0;
    for (auto _ : state) {
        std::fill(out.values.begin(), out.values.end(), value += 1);
        benchmark::ClobberMemory();
    }
    count_vertices(state, vertices);
}

void register_cases(const bend::Body& body) {
    for (const bool normals : {false, true}) {
        const std::string streams = normals ? "positions+normals" : "positions";
        benchmark::RegisterBenchmark(("naive/" + streams).c_str(), naive, normals);
        benchmark::RegisterBenchmark(("floor/fill/" + streams).c_str(), fill, normals ? 6 : 3);
        for (const Isa isa : built_isas()) {
            if (!runs_here(isa)) continue;
            const std::string name = "deform/" + streams + "/cache/" + std::string(goffer::name(isa)) + "/1";
            benchmark::RegisterBenchmark(name.c_str(), [&body, isa, normals](benchmark::State& state) {
                deform(state, body, isa, normals);
            });
            for (const bool parallel : {false, true}) {
                const std::string crowd = "deform/" + streams + "/crowd/" + std::string(goffer::name(isa)) +
                                          (parallel ? "/all" : "/1");
                benchmark::RegisterBenchmark(crowd.c_str(),
                                             [&body, isa, normals, parallel](benchmark::State& state) {
                                                 deform_crowd(state, body, isa, normals, parallel);
                                             });
            }
        }
    }
}

}  // namespace
}  // namespace goffer::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const goffer::bend::Body body = goffer::bench::make_body(goffer::bench::vertices);
    goffer::bench::register_cases(body);
    goffer::bench::RatioReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
}
