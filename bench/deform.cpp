// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "floor.hpp"
#include "measure.hpp"

#include <goffer/measure/crowd_scene.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace goffer::bench {
namespace {

using measure::StreamLayout, measure::stream_layout;

/// How many instances of how large a body.
struct Size {
    std::size_t instances;
    std::size_t vertices;

    [[nodiscard]] std::size_t total() const { return instances * vertices; }
};

struct DeformCase {
    StreamLayout layout;
    Size size;
    Isa isa;
    int threads;
    Shape shape = Shape::plain;
    float wrinkle_weight = 1;
    bool scratch = false;  ///< what lies between instances may be written over
    bool dense = false;    ///< nothing lies there; else each instance begins on a cache line of every plane

    /// From one instance's first vertex to the next one's.
    [[nodiscard]] std::size_t vertex_step() const {
        constexpr std::size_t line = column_alignment / sizeof(float);
        return dense ? size.vertices : (size.vertices + line - 1) / line * line;
    }
    [[nodiscard]] std::size_t memory_floats() const {
        return layout.memory_floats(size.instances * vertex_step());
    }
};

/// Instances whose poses change from sample to sample.
class Crowd {
public:
    Crowd(Fixture& fixture, const DeformCase& what)
        : what_(what),
          scene_({{&fixture.body(what.size.vertices, what.shape), what.size.instances, what.vertex_step()}},
                 what.layout, fixture.memory(what.memory_floats())),
          weights_(what.size.instances, what.wrinkle_weight) {
        if (what.scratch) scene_.batches()[0].scratch_gaps = true;
        if (what.wrinkle_weight != 1) scene_.batches()[0].wrinkle_weights = strided(std::span(weights_));
        single_ = scene_.instance(0);
        single_.isa = what.isa;
        next_poses();
    }

    void next_poses() {
        phase_ += 0.01f;
        scene_.set_poses([&](std::size_t instance, std::span<bend::Pose> poses) {
            auto at = static_cast<float>(instance * poses.size());
            for (bend::Pose& pose : poses) {
                pose = {(1.0f + 0.5f * std::sin(phase_ + at)) / static_cast<float>(poses.size()), at};
                ++at;
            }
        });
    }

    /// One instance is validated and run as a job, more as a crowd.
    [[nodiscard]] bend::Fault fault() const { return is_single() ? validate(single_) : validate(job()); }
    void run() const {
        if (is_single()) {
            what_.threads == 1 ? bend::run(single_) : bend::run_parallel(single_);
        } else {
            what_.threads == 1 ? bend::run(job()) : bend::run_parallel(job());
        }
    }

private:
    [[nodiscard]] bool is_single() const { return what_.size.instances == 1; }
    [[nodiscard]] bend::CrowdJob job() const { return scene_.job(what_.isa); }

    DeformCase what_;
    measure::CrowdScene scene_;
    bend::DeformJob single_;
    std::vector<float> weights_;
    float phase_ = 0;
};

void deform(benchmark::State& state, Fixture& fixture, const DeformCase& what) {
    Crowd crowd(fixture, what);
    if (const bend::Fault fault = crowd.fault(); !fault.none()) {
        state.SkipWithError(bend::describe(fault).c_str());
        return;
    }
    Task task;
    task.batch = batch_for(what.size.total());
    task.threads = what.threads;
    task.prepare = [&] { crowd.next_poses(); };
    task.work = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            crowd.run();
            benchmark::ClobberMemory();
        }
    };
    task.floor = floor_of(fixture, what.layout, what.size.total(), what.threads);
    fixture.with_threads(what.threads, [&] {
        report(state, measure(state, task), what.size.total(),
               what.size.total() * what.layout.floats * sizeof(float));
    });
}

void register_case(Fixture& fixture, const std::string& group, const std::string& size,
                   const DeformCase& what) {
    const std::string name = group + "/" + std::string(what.layout.name) + "/" + size + "/" +
                             std::string(goffer::name(what.isa)) + "/" + std::to_string(what.threads);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&fixture, what](benchmark::State& state) { deform(state, fixture, what); });
}

}  // namespace

void register_deform(Fixture& fixture) {
    struct Named {
        std::string name;
        Size size;
    };
    const Named sizes[] = {
        {"cache", {1, 10'000}}, {"crowd", {1000, 10'000}}, {"crowd10000x200", {10'000, 200}}};
    struct Like {
        std::string name;
        Shape shape;
        float wrinkle_weight;
    };
    const Like others[] = {{"-regions8", Shape::regions, 1},
                           {"-joints8", Shape::joints, 1},
                           {"-arc", Shape::arc, 1},
                           {"-taper", Shape::taper, 1},
                           {"-bare", Shape::plain, 0}};
    for (const StreamLayout& layout : measure::stream_layouts()) {
        for (const Named& size : sizes) {
            for (const Isa isa : built_isas()) {
                if (!runs_here(isa)) continue;
                for (const int threads : Fixture::thread_counts())
                    register_case(fixture, "deform", size.name, {layout, size.size, isa, threads});
                if (layout.name != "positions" && layout.name != "positions+normals" &&
                    layout.name != "record32-positions+normals")
                    continue;
                for (const Like& like : others)
                    register_case(fixture, "deform", size.name + like.name,
                                  {layout, size.size, isa, 1, like.shape, like.wrinkle_weight});
            }
        }
    }
    for (const char* streams : {"positions", "positions+normals"}) {
        for (const Isa isa : built_isas()) {
            if (!runs_here(isa)) continue;
            DeformCase what = {stream_layout(streams), {10'000, 200}, isa, 1};
            what.scratch = true;
            register_case(fixture, "deform", "crowd10000x200-scratch", what);
            what.scratch = false;
            what.dense = true;
            register_case(fixture, "deform", "crowd10000x200-dense", what);
        }
    }
    // Its output stays in the cache: the gate compares it in pairs.
    for (const Isa isa : built_isas()) {
        if (runs_here(isa))
            register_case(fixture, "deform", "crowd500x200-joints8",
                          {stream_layout("positions+normals"), {500, 200}, isa, 1, Shape::joints, 1});
    }
}

void register_sweep(Fixture& fixture) {
    constexpr std::size_t max_bytes = 500'000'000;
    for (const char* streams : {"positions", "positions+normals"}) {
        for (const std::size_t vertices : {200, 500, 2'000, 10'000, 50'000, 200'000, 1'000'000}) {
            for (const std::size_t instances : {1, 10, 100, 1'000, 10'000}) {
                DeformCase what = {stream_layout(streams), {instances, vertices}, resolve(Isa::automatic), 1};
                if (what.memory_floats() * sizeof(float) > max_bytes) continue;
                const std::string name = std::to_string(instances) + "x" + std::to_string(vertices);
                for (const int threads : Fixture::thread_counts()) {
                    what.threads = threads;
                    register_case(fixture, "sweep", name, what);
                }
            }
        }
    }
}

}  // namespace goffer::bench
