// SPDX-License-Identifier: MIT

// How do I run a crowd as jobs of my engine's job system? job_system FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <array>
#include <atomic>
#include <cstdio>
#include <functional>
#include <semaphore>
#include <thread>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: job_system FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const auto file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    constexpr std::size_t worms = 200, pieces = 16;
    std::vector<bend::Pose> poses(worms * body.region_count());
    std::vector<glm::vec3> vertices(worms * body.vertex_count());
    bend::Batch batch{.body = &body, .count = worms, .vertex_step = body.vertex_count()};
    batch.poses = {.data = poses.data(), .count = worms};
    batch.poses.stride *= static_cast<std::uint32_t>(body.region_count());
    batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    // A job system as engines have one, in short: a queue of up to 64 jobs, which this thread adds to,
    // workers that take them (an empty one ends a worker), and a counter of those that are done, to wait on.
    std::array<std::function<void()>, 64> queue;
    std::size_t added = 0;
    std::atomic<std::size_t> taken{0};
    std::counting_semaphore<> waiting{0}, done{0};
    const auto add = [&](std::function<void()> job) {
        queue[added++ % queue.size()] = std::move(job);
        waiting.release();
    };
    const auto take = [&] { return waiting.acquire(), queue[taken++ % queue.size()]; };
    const auto work = [&] {
        while (const std::function<void()> job = take()) job(), done.release();
    };
    std::thread workers[]{std::thread(work), std::thread(work), std::thread(work)};

    for (std::size_t frame = 0; frame < 3; ++frame) {
        for (std::size_t i = 0; i < poses.size(); ++i) poses[i].angle = 0.01f * static_cast<float>(frame + i);
        add([frame] { std::printf("frame %zu: a job of the game's own, ", frame); });
        for (std::size_t p = 0; p < pieces; ++p) add([&, p] { bend::run_piece(crowd, p, pieces); });
        for (std::size_t p = 0; p <= pieces; ++p) done.acquire();
        const std::vector<glm::vec3> together = vertices;
        bend::run(crowd);
        std::printf("%zu of the crowd: %s\n", pieces, together == vertices ? "as on one thread" : "wrong");
    }
    for (std::size_t i = 0; i < std::size(workers); ++i) add({});
    for (std::thread& worker : workers) worker.join();
}
