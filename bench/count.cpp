// SPDX-License-Identifier: MIT
#include "fixture.hpp"
#include "model.hpp"

#include <goffer/measure/allocations.hpp>
#include <goffer/measure/crowd_scene.hpp>

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>

/// goffer_count: what bench/gate counts instead of timing, the same in every run.

/// A frame on the calling thread. bench/gate has callgrind write out every call of it, by its name.
extern "C" [[gnu::noinline]] void goffer_counted_frame(const goffer::bend::CrowdJob& crowd) {
    goffer::bend::run(crowd);
}

namespace goffer::bench {
namespace {

struct Size {
    std::size_t instances;
    std::size_t vertices;  // of each
};

/// Instances in poses of their own, in the fixture's memory.
measure::CrowdScene make_crowd(Fixture& fixture, const char* streams, const Size& size) {
    const measure::StreamLayout& layout = measure::stream_layout(streams);
    measure::CrowdScene crowd({{&fixture.body(size.vertices), size.instances, size.vertices}}, layout,
                              fixture.memory(layout.memory_floats(size.instances * size.vertices)));
    crowd.set_poses([](std::size_t instance, std::span<bend::Pose> poses) {
        poses[0] = {1.0f, static_cast<float>(instance)};
    });
    return crowd;
}

/// Two sizes that differ in vertices alone and two that differ in instances alone, so that a difference
/// leaves out what any frame costs. Whole blocks of vertices, whole groups of instances.
constexpr Size sizes[] = {{1, 1024}, {1, 3072}, {16, 64}, {48, 64}};

constexpr const char* counted_layouts[] = {"positions", "positions+normals", "positions+normals+tangents",
                                           "interleaved-positions+normals", "packed"};

/// Makes a counted frame for each kernel, layout and size, and prints a line for each, in order:
/// <isa> <layout> <instances> <vertices>
void count_work() {
    Fixture fixture;
    for (const Isa isa : built_isas()) {
        if (!runs_here(isa)) continue;
        for (const char* name : counted_layouts) {
            for (const Size& size : sizes) {
                const measure::CrowdScene crowd = make_crowd(fixture, name, size);
                bend::run(crowd.job(isa));  // what only a first frame does
                goffer_counted_frame(crowd.job(isa));
                std::printf("%s %s %zu %zu\n", std::string(goffer::name(isa)).c_str(), name, size.instances,
                            size.vertices);
            }
        }
    }
}

/// Allocations per call of `frame`, once it is warm; below 0 where they are not counted.
template <class Frame>
double allocations_of(const Frame& frame) {
    constexpr int frames = 100;
    for (int i = 0; i < 5; ++i) frame();
    const auto before = measure::allocations();
    if (!before) return -1;
    for (int i = 0; i < frames; ++i) frame();
    return static_cast<double>(*measure::allocations() - *before) / frames;
}

/// Bytes that each vertex adds to a body.
double bytes_per_vertex(bool tangents) {
    constexpr std::size_t step = 8000;
    const auto bytes = [&](std::size_t vertices) {
        Model model(vertices);
        if (!tangents) model.tangents.clear();
        return bind_model(model).bytes();
    };
    return static_cast<double>(bytes(2 * step) - bytes(step)) / step;
}

void print(const char* name, double value) {
    std::printf("%s %.2f\n", name, value);
}

/// Prints a line for each count: <name> <number>
void count_memory() {
    Fixture fixture;
    const Size size{50, 200};
    const measure::CrowdScene planes = make_crowd(fixture, "positions+normals", size);
    print("allocations/run", allocations_of([&] { bend::run(planes.job()); }));
    fixture.with_threads(1, [&] {
        print("allocations/run_parallel", allocations_of([&] { bend::run_parallel(planes.job()); }));
    });
    const measure::CrowdScene packed = make_crowd(fixture, "packed", size);
    print("allocations/run/packed", allocations_of([&] { bend::run(packed.job()); }));
    print("bytes_per_vertex/without_tangents", bytes_per_vertex(false));
    print("bytes_per_vertex/with_tangents", bytes_per_vertex(true));
}

}  // namespace
}  // namespace goffer::bench

int main(int count, char** words) {
    const std::span<char*> given(words, static_cast<std::size_t>(count));
    if (given.size() == 2 && std::strcmp(given[1], "work") == 0) {
        goffer::bench::count_work();
    } else if (given.size() == 2 && std::strcmp(given[1], "memory") == 0) {
        goffer::bench::count_memory();
    } else {
        std::fputs("usage: goffer_count work|memory (bench/gate runs it)\n", stderr);
        return 2;
    }
}
