// SPDX-License-Identifier: MIT

// How do I run a crowd on threads of my own? own_scheduler FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <thread>
#include <vector>

using namespace goffer;

struct Worm {
    bend::Pose pose;
    glm::mat4x3 model{1};
};

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: own_scheduler FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    std::vector<Worm> worms(200);
    for (std::size_t i = 0; i < worms.size(); ++i) worms[i].pose.angle = std::sin(static_cast<float>(i));
    std::vector<glm::vec3> vertices(worms.size() * body.vertex_count());
    bend::Batch batch{.body = &body, .count = worms.size()};
    batch.poses = strided(std::span(worms), &Worm::pose);
    batch.transforms = strided(std::span(worms), &Worm::model);
    batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
    batch.vertex_step = body.vertex_count();
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    if (const bend::Fault bad = bend::validate(crowd); !bad.none())
        return std::printf("%s\n", bend::describe(bad).c_str()), 1;

    // Each piece is a job for your job system: any thread, any order. Several per thread balance the load.
    constexpr std::size_t threads = 4, pieces = 4 * threads;
    std::vector<bend::CrowdResult> results(pieces);
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < threads; ++t) {
        pool.emplace_back([&, t] {
            for (std::size_t p = t; p < pieces; p += threads) results[p] = bend::run_piece(crowd, p, pieces);
        });
    }
    for (std::thread& thread : pool) thread.join();
    bend::CrowdResult sum;
    for (const bend::CrowdResult& result : results) sum += result;
    std::printf("%zu instances in %zu pieces\n", sum.deformed, pieces);
}
