// SPDX-License-Identifier: MIT

// How do I skip what is not seen, and do less for what is far away? culling_and_detail FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <algorithm>
#include <cstdio>
#include <span>
#include <vector>

using namespace goffer;

struct Worm {
    bend::Pose pose{.angle = 1};
    glm::mat4x3 model{1};
    std::uint8_t visible = 0, interval = 1;
    float weight = 1;
};

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: culling_and_detail FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const auto file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    const auto length = static_cast<float>(body.length());
    std::vector<Worm> worms(100);
    for (std::size_t i = 0; i < worms.size(); ++i) worms[i].model[3].x = 2 * length * static_cast<float>(i);
    std::vector<glm::vec3> vertices(worms.size() * body.vertex_count());
    bend::Batch batch{.body = &body, .count = worms.size(), .vertex_step = body.vertex_count()};
    batch.poses = strided(std::span(worms), &Worm::pose);
    batch.transforms = strided(std::span(worms), &Worm::model);
    batch.visible = strided(std::span(worms), &Worm::visible);
    batch.update_intervals = strided(std::span(worms), &Worm::interval);
    batch.wrinkle_weights = strided(std::span(worms), &Worm::weight);
    batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
    if (const bend::Fault bad = bend::validate({.batches = {&batch, 1}}); !bad.none())
        return std::printf("%s\n", bend::describe(bad).c_str()), 1;

    // Bounds come from the poses alone: cull before a vertex is touched. Here, all beyond a plane.
    std::vector<bend::Bounds> boxes(worms.size());
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        bend::bounds(batch, boxes);
        for (std::size_t i = 0; i < worms.size(); ++i) {
            Worm& worm = worms[i];
            const float distance = boxes[i].low.x / length;
            // What appears has to be deformed now; what is far, in every fourth frame.
            worm.interval = distance < 40 || worm.visible == 0 ? 1 : 4;
            worm.visible = distance < 120 ? 1 : 0;
            worm.weight = std::clamp((60 - distance) / 20, 0.0f, 1.0f);  // wrinkles fade out
        }
        const bend::CrowdResult result = bend::run_parallel({.batches = {&batch, 1}, .frame = frame});
        std::printf("frame %u: %zu of %zu\n", frame, result.deformed, worms.size());
    }
}
