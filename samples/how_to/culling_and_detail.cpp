// SPDX-License-Identifier: MIT

// How do I skip what is not seen, and do less for what is far away? culling_and_detail FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
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
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s\n", bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    const auto length = static_cast<float>(body.length());
    std::vector<Worm> worms(100);
    for (std::size_t i = 0; i < worms.size(); ++i) worms[i].model[3].x = 2 * length * static_cast<float>(i);
    std::vector<glm::vec3> vertices(worms.size() * body.vertex_count());
    const std::span all(worms);
    bend::Batch batch{.body = &body, .count = worms.size()};
    batch.poses = strided(all, &Worm::pose);
    batch.transforms = strided(all, &Worm::model);
    batch.visible = strided(all, &Worm::visible);
    batch.update_intervals = strided(all, &Worm::interval);
    batch.wrinkle_weights = strided(all, &Worm::weight);
    batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
    batch.vertex_step = body.vertex_count();

    if (const bend::Fault bad = bend::validate(bend::CrowdJob{.batches = {&batch, 1}}); !bad.none())
        return std::printf("%s\n", bend::describe(bad).c_str()), 1;

    // Bounds come from the poses alone: cull before a vertex is touched. Here, all beyond a plane.
    std::vector<bend::Bounds> boxes(worms.size());
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        bend::bounds(batch, boxes);
        for (std::size_t i = 0; i < worms.size(); ++i) {
            const float distance = boxes[i].low.x / length;
            const bool appears = worms[i].visible == 0;  // its vertices are out of date
            worms[i].visible = distance < 120 ? 1 : 0;
            worms[i].interval = distance < 40 || appears ? 1 : 4;            // a turn in every fourth frame
            worms[i].weight = std::clamp((60 - distance) / 20, 0.0f, 1.0f);  // wrinkles fade out
        }
        const bend::CrowdResult result = bend::run_parallel({.batches = {&batch, 1}, .frame = frame});
        std::printf("frame %u: %zu of %zu\n", frame, result.deformed, worms.size());
    }
}
