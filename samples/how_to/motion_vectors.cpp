// SPDX-License-Identifier: MIT

// How do I get motion vectors? motion_vectors FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

using namespace goffer;

struct Worm {
    bend::Pose pose, pose_before;
    glm::mat4x3 model{1}, model_before{1};
};
struct Vertex {
    glm::vec3 now, before;  // a shader projects both, with this frame's camera and the last one's
};

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: motion_vectors FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    std::vector<Worm> worms(10);
    std::vector<Vertex> vertices(worms.size() * body.vertex_count());
    const std::span all(worms);
    bend::Batch batch{.body = &body, .count = worms.size()};
    batch.poses = strided(all, &Worm::pose);
    batch.transforms = strided(all, &Worm::model);
    batch.previous_poses = strided(all, &Worm::pose_before);
    batch.previous_transforms = strided(all, &Worm::model_before);
    batch.positions = interleaved<3>(&vertices[0].now.x, vertices.size(), sizeof(Vertex));
    batch.previous_positions = interleaved<3>(&vertices[0].before.x, vertices.size(), sizeof(Vertex));
    batch.vertex_step = body.vertex_count();
    for (int frame = 0; frame < 3; ++frame) {
        for (Worm& worm : worms) {
            worm.pose_before = worm.pose;
            worm.model_before = worm.model;
            worm.pose.angle = 0.2f * static_cast<float>(frame);
        }
        bend::run_parallel({.batches = {&batch, 1}});
        double farthest = 0;
        for (const Vertex& vertex : vertices)
            farthest = std::max(farthest, static_cast<double>(glm::distance(vertex.now, vertex.before)));
        std::printf("frame %d: moved by %.3f at most\n", frame, farthest);
    }
}
