// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "floor.hpp"
#include "layout.hpp"
#include "measure.hpp"

#include <goffer/bend/crowd.hpp>

#include <cmath>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace goffer::bench {
namespace {

/// How many instances of how large a body.
struct Size {
    std::size_t instances;
    std::size_t vertices;

    [[nodiscard]] std::size_t total() const { return instances * vertices; }
};

struct DeformCase {
    Layout layout;
    Size size;
    Isa isa;
    int threads;
    Shape shape = Shape::plain;
    bool wrinkles = true;
};

/// Instances whose poses change from sample to sample. Each begins on a cache line of every plane: what a
/// user is advised to do.
class Crowd {
public:
    Crowd(Stage& stage, const DeformCase& what) : jobs_(what.size.instances) {
        const bend::Body& body = stage.body(what.size.vertices, what.shape);
        poses_.resize(jobs_.size() * body.region_count());
        previous_poses_.resize(poses_.size());
        const std::size_t padded = padded_vertices(what.size);
        const CrowdMemory memory{stage.memory(memory_floats(what.layout, what.size)).data(),
                                 capacity(what.layout, what.size)};
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            jobs_[i].body = &body;
            jobs_[i].isa = what.isa;
            jobs_[i].wrinkles = what.wrinkles;
            const std::size_t regions = body.region_count();
            jobs_[i].poses = std::span(poses_).subspan(i * regions, regions);
            jobs_[i].previous_poses = std::span(previous_poses_).subspan(i * regions, regions);
            set_streams(jobs_[i], what.layout, memory, i * padded);
        }
        next_poses();
    }

    void next_poses() {
        phase_ += 0.01f;
        previous_poses_ = poses_;
        const std::size_t regions = poses_.size() / jobs_.size();
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const auto at = static_cast<float>(i);
            poses_[i] = {(1.0f + 0.5f * std::sin(phase_ + at)) / static_cast<float>(regions), at};
        }
    }

    [[nodiscard]] bend::CrowdJob job() const { return {.instances = jobs_}; }

    [[nodiscard]] static std::size_t memory_floats(const Layout& layout, const Size& size) {
        return capacity(layout, size) * layout.footprint();
    }

private:
    [[nodiscard]] static std::size_t capacity(const Layout& layout, const Size& size) {
        return capacity_for(layout, size.instances * padded_vertices(size));
    }

    [[nodiscard]] static std::size_t padded_vertices(const Size& size) {
        constexpr std::size_t line = column_alignment / sizeof(float);
        return (size.vertices + line - 1) / line * line;
    }

    std::vector<bend::DeformJob> jobs_;
    std::vector<bend::Pose> poses_, previous_poses_;  // of one instance after the other
    float phase_ = 0;
};

/// One instance is run as a job, more as a crowd.
void run_once(const bend::CrowdJob& crowd, int threads) {
    if (crowd.instances.size() == 1) {
        threads == 1 ? bend::run(crowd.instances[0]) : bend::run_parallel(crowd.instances[0]);
    } else {
        threads == 1 ? bend::run(crowd) : bend::run_parallel(crowd);
    }
}

void deform(benchmark::State& state, Stage& stage, const DeformCase& what) {
    Crowd crowd(stage, what);
    if (const bend::CrowdFault fault = bend::validate(crowd.job()); !fault.none()) {
        state.SkipWithError(std::string(bend::describe(fault)).c_str());
        return;
    }
    Task task;
    task.batch = batch_for(what.size.total());
    task.threads = what.threads;
    task.prepare = [&] { crowd.next_poses(); };
    task.work = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            run_once(crowd.job(), what.threads);
            benchmark::ClobberMemory();
        }
    };
    const std::size_t floats = what.size.total() * what.layout.floats;
    task.floor = floor_of(stage, floats, what.threads);
    stage.with_threads(what.threads, [&] {
        report(state, measure(state, task), what.size.total(), floats * sizeof(float));
    });
}

void register_case(Stage& stage, const std::string& group, const std::string& size, const DeformCase& what) {
    const std::string name = group + "/" + std::string(what.layout.name) + "/" + size + "/" +
                             std::string(goffer::name(what.isa)) + "/" + std::to_string(what.threads);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&stage, what](benchmark::State& state) { deform(state, stage, what); });
}

}  // namespace

void register_deform(Stage& stage) {
    struct Named {
        std::string name;
        Size size;
    };
    const Named sizes[] = {
        {"cache", {1, 10'000}}, {"crowd", {1000, 10'000}}, {"crowd10000x200", {10'000, 200}}};
    struct Like {
        std::string name;
        Shape shape;
        bool wrinkles;
    };
    const Like others[] = {
        {"-regions8", Shape::regions, true}, {"-arc", Shape::arc, true}, {"-bare", Shape::plain, false}};
    for (const Layout& layout : layouts()) {
        for (const Named& size : sizes) {
            for (const Isa isa : built_isas()) {
                if (!runs_here(isa)) continue;
                for (const int threads : Stage::thread_counts())
                    register_case(stage, "deform", size.name, {layout, size.size, isa, threads});
                if (layout.name != "positions" && layout.name != "positions+normals") continue;
                for (const Like& like : others)
                    register_case(stage, "deform", size.name + like.name,
                                  {layout, size.size, isa, 1, like.shape, like.wrinkles});
            }
        }
    }
}

void register_sweep(Stage& stage) {
    constexpr std::size_t most_bytes = 500'000'000;
    for (const char* streams : {"positions", "positions+normals"}) {
        for (const std::size_t vertices : {200, 500, 2'000, 10'000, 50'000, 200'000, 1'000'000}) {
            for (const std::size_t instances : {1, 10, 100, 1'000, 10'000}) {
                const Size size{instances, vertices};
                if (Crowd::memory_floats(layout(streams), size) * sizeof(float) > most_bytes) continue;
                const std::string name = std::to_string(instances) + "x" + std::to_string(vertices);
                for (const int threads : Stage::thread_counts())
                    register_case(stage, "sweep", name,
                                  {layout(streams), size, resolve(Isa::automatic), threads});
            }
        }
    }
}

}  // namespace goffer::bench
