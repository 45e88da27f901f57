// SPDX-License-Identifier: MIT

// How do I skin a body that was bent, as a tail of a skinned animal? skinning FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/job.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: skinning FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const auto& [body, mesh, rest] = file->levels[0];

    // Skin weights are the model's, one per vertex of its file; `source` says which vertex that is. Those
    // here are made up.
    if (mesh.source.empty()) return std::puts("this file does not say which vertices it has"), 1;
    const std::size_t count = body.vertex_count();
    std::vector<float> weights(count);
    for (std::size_t i = 0; i < count; ++i) weights[i] = static_cast<float>(mesh.source[i] % 101) / 100;

    // First bend, in model space, ..
    const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.4f});
    std::vector<glm::vec3> positions(count);
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&positions[0].x, count);
    bend::run(job);

    // .. then skin what was bent as if it were the rest shape: on the GPU, or here.
    const glm::mat4x3 bones[2] = {glm::mat4x3(1), {1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0}};
    float widest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::mat4x3 bone = (1 - weights[i]) * bones[0] + weights[i] * bones[1];
        positions[i] = bone * glm::vec4(positions[i], 1);
        widest = std::max(widest, positions[i].x);
    }
    std::printf("%zu vertices, bent and skinned: x to %.1f, %.1f at rest\n", count,
                static_cast<double>(widest), static_cast<double>(rest.high.x));
}
