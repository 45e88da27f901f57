// SPDX-License-Identifier: MIT

// How do I send 12 bytes a vertex to the GPU? packed FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/packed.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

using namespace goffer;

// On the GPU, a vertex shader includes the same file, goffer/bend/packed.glsl, or packed.hlsl for HLSL. Here
// it is compiled as C++, to see how exact it is. modules/gpu/README.md has a shader, and how to declare
// attributes.
namespace shader {
using namespace glm;
#include <goffer/bend/packed.glsl>
}  // namespace shader

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: packed FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    const std::size_t count = body.vertex_count();
    const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.8f});
    std::vector<bend::PackedVertex> packed(count);
    std::vector<glm::vec3> exact(count);
    bend::Bounds box;
    bend::DeformJob job{.body = &body, .poses = poses};
    job.packed = {packed.data(), sizeof packed[0], count};
    job.bounds = &box;  // what positions are relative to
    job.positions = interleaved<3>(&exact[0].x, count);
    bend::run(job);

    double farthest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        glm::uvec3 words;
        std::memcpy(&words, &packed[i], sizeof words);
        const glm::vec3 decoded = shader::goffer_position(words, box.low, box.high);
        farthest = std::max(farthest, static_cast<double>(glm::distance(decoded, exact[i])));
    }
    std::printf("%zu bytes instead of %zu, off by %.0e of the length\n", count * sizeof packed[0],
                count * 2 * sizeof(glm::vec3), farthest / body.length());
}
