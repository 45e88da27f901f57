// SPDX-License-Identifier: MIT

// How do I keep a crowd to some of oneTBB's threads? tbb_arena FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: tbb_arena FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    std::vector<bend::Pose> poses(200);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].angle = std::sin(static_cast<float>(i));
    std::vector<glm::vec3> vertices(poses.size() * body.vertex_count());
    bend::Batch batch{.body = &body, .count = poses.size()};
    batch.poses = strided(std::span<const bend::Pose>(poses));
    batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
    batch.vertex_step = body.vertex_count();

    // run_parallel uses the arena that it is called from, sets nothing global, and is a task like others:
    // here beside the game's own work.
    tbb::task_arena arena(2);
    bend::CrowdResult result;
    double work = 0;
    arena.execute([&] {
        tbb::task_group frame;
        frame.run([&] { result = bend::run_parallel({.batches = {&batch, 1}}); });
        frame.run([&] { work = std::sqrt(2.0); });
        frame.wait();
    });
    std::printf("%zu instances on 2 threads, and %.3f\n", result.deformed, work);
}
