// SPDX-License-Identifier: MIT

// How do I draw coarser meshes of what is far away? levels FILE.goffer (of goffer bake --lod)

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

using namespace goffer;

struct Worm {
    bend::Pose pose{.angle = 1};
    float place = 0, weight = 1;     // place: in a row, here instead of a matrix
    std::uint32_t first_vertex = 0;  // in a buffer with room for the finest level of each
};

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: levels FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const auto file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const auto& levels = file->levels;  // from fine to coarse; one array of poses serves all
    if (levels[0].body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
    if (levels.size() == 1) std::puts("this file has one level: goffer bake --lod adds coarser ones");
    std::vector<Worm> worms(100);
    std::size_t room = 0;  // vertices of the finest level
    for (const bend::BodyFileLevel& level : levels) room = std::max(room, level.body.vertex_count());
    for (std::uint32_t i = 0; i < worms.size(); ++i)
        worms[i] = {.place = static_cast<float>(i), .first_vertex = i * static_cast<std::uint32_t>(room)};
    std::vector<glm::vec3> vertices(worms.size() * room);
    std::vector<std::vector<std::uint32_t>> worms_of(levels.size());
    std::vector<bend::Batch> batches(levels.size());
    for (int frame = 0; frame < 3; ++frame) {
        for (std::vector<std::uint32_t>& indices : worms_of) indices.clear();
        for (std::uint32_t i = 0; i < worms.size(); ++i) {
            const float distance = std::abs(worms[i].place - 5 * static_cast<float>(frame));
            std::size_t level = 0;
            for (float until = 10; distance >= until && level + 1 < levels.size(); until *= 2) ++level;
            worms_of[level].push_back(i);
            // Wrinkles fade out before the mesh is too coarse for them.
            worms[i].weight = std::clamp((10 - distance) / 5, 0.0f, 1.0f);
        }
        for (std::size_t l = 0; l < levels.size(); ++l) {
            batches[l] = {.body = &levels[l].body, .count = worms_of[l].size(), .indices = worms_of[l]};
            batches[l].poses = strided(std::span(worms), &Worm::pose);
            batches[l].wrinkle_weights = strided(std::span(worms), &Worm::weight);
            batches[l].positions = interleaved<3>(&vertices[0].x, vertices.size());
            batches[l].vertex_offsets = strided(std::span(worms), &Worm::first_vertex);
            std::printf("frame %d, level %zu: %zu worms of %zu triangles\n", frame, l, worms_of[l].size(),
                        levels[l].mesh.triangles.size() / 3);
        }
        std::printf("frame %d: %zu bent\n", frame, bend::run_parallel({.batches = batches}).deformed);
    }
}
