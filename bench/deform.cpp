// SPDX-License-Identifier: MIT
#include "cases.hpp"
#include "floor.hpp"
#include "layout.hpp"
#include "measure.hpp"

#include <goffer/bend/crowd.hpp>

#include <cmath>
#include <cstdint>
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
    StreamLayout layout;
    Size size;
    Isa isa;
    int threads;
    Shape shape = Shape::plain;
    float wrinkle_weight = 1;
};

/// Instances whose poses change from sample to sample. Each begins on a cache line of every plane: what a
/// user is advised to do.
class Crowd {
public:
    Crowd(Fixture& fixture, const DeformCase& what)
        : what_(what), body_(fixture.body(what.size.vertices, what.shape)) {
        poses_.resize(what.size.instances * body_.region_count());
        previous_poses_.resize(poses_.size());
        weights_.resize(what.size.instances, what.wrinkle_weight);
        memory_ = {fixture.memory(memory_floats(what.layout, what.size)).data(),
                   capacity(what.layout, what.size)};
        set_batch();
        set_single();
        next_poses();
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    void next_poses() {
        phase_ += 0.01f;
        previous_poses_ = poses_;
        const std::size_t regions = body_.region_count();
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const auto at = static_cast<float>(i);
            poses_[i] = {(1.0f + 0.5f * std::sin(phase_ + at)) / static_cast<float>(regions), at};
        }
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

    [[nodiscard]] static std::size_t memory_floats(const StreamLayout& layout, const Size& size) {
        return capacity(layout, size) * layout.footprint();
    }

private:
    [[nodiscard]] static std::size_t capacity(const StreamLayout& layout, const Size& size) {
        return capacity_for(layout, size.instances * padded_vertices(size));
    }

    [[nodiscard]] static std::size_t padded_vertices(const Size& size) {
        constexpr std::size_t line = column_alignment / sizeof(float);
        return (size.vertices + line - 1) / line * line;
    }

    void set_batch() {
        batch_.body = &body_;
        batch_.count = what_.size.instances;
        batch_.poses = by_instance(poses_);
        if (what_.layout.previous) batch_.previous_poses = by_instance(previous_poses_);
        if (what_.wrinkle_weight != 1) batch_.wrinkle_weights = strided(std::span(weights_));
        batch_.vertex_step = padded_vertices(what_.size);
        set_streams(batch_, what_.layout, memory_);
    }

    void set_single() {
        single_.body = &body_;
        single_.poses = std::span(poses_).first(body_.region_count());
        single_.previous_poses = std::span(previous_poses_).first(body_.region_count());
        single_.wrinkle_weight = what_.wrinkle_weight;
        single_.isa = what_.isa;
        set_streams(single_, what_.layout, memory_, 0);
    }

    /// The poses of all regions of each instance.
    [[nodiscard]] StridedView<bend::Pose> by_instance(std::span<const bend::Pose> poses) const {
        return {.data = poses.data(),
                .count = what_.size.instances,
                .stride = static_cast<std::uint32_t>(body_.region_count() * sizeof(bend::Pose))};
    }

    [[nodiscard]] bool is_single() const { return what_.size.instances == 1; }
    [[nodiscard]] bend::CrowdJob job() const { return {.batches = {&batch_, 1}, .isa = what_.isa}; }

    DeformCase what_;
    const bend::Body& body_;
    CrowdMemory memory_;
    std::vector<bend::Pose> poses_, previous_poses_;  // of one instance after the other
    std::vector<float> weights_;
    float phase_ = 0;
    bend::Batch batch_;
    bend::DeformJob single_;
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
    const Like others[] = {
        {"-regions8", Shape::regions, 1}, {"-arc", Shape::arc, 1}, {"-bare", Shape::plain, 0}};
    for (const StreamLayout& layout : layouts()) {
        for (const Named& size : sizes) {
            for (const Isa isa : built_isas()) {
                if (!runs_here(isa)) continue;
                for (const int threads : Fixture::thread_counts())
                    register_case(fixture, "deform", size.name, {layout, size.size, isa, threads});
                if (layout.name != "positions" && layout.name != "positions+normals") continue;
                for (const Like& like : others)
                    register_case(fixture, "deform", size.name + like.name,
                                  {layout, size.size, isa, 1, like.shape, like.wrinkle_weight});
            }
        }
    }
}

void register_sweep(Fixture& fixture) {
    constexpr std::size_t most_bytes = 500'000'000;
    for (const char* streams : {"positions", "positions+normals"}) {
        for (const std::size_t vertices : {200, 500, 2'000, 10'000, 50'000, 200'000, 1'000'000}) {
            for (const std::size_t instances : {1, 10, 100, 1'000, 10'000}) {
                const Size size{instances, vertices};
                if (Crowd::memory_floats(layout(streams), size) * sizeof(float) > most_bytes) continue;
                const std::string name = std::to_string(instances) + "x" + std::to_string(vertices);
                for (const int threads : Fixture::thread_counts())
                    register_case(fixture, "sweep", name,
                                  {layout(streams), size, resolve(Isa::automatic), threads});
            }
        }
    }
}

}  // namespace goffer::bench
