// SPDX-License-Identifier: MIT

// How do I bend a crowd of several bodies? crowd FILE.goffer OTHER.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

using namespace goffer;

struct Creature {  // and whatever else the game keeps of one
    bend::Pose pose;
    glm::mat4x3 model{1};
};

int main(int argc, char** argv) {
    if (argc != 3) return std::puts("usage: crowd FILE.goffer OTHER.goffer"), 2;
    // Once: the creatures of one body are a batch, which refers to the game's own array of them.
    std::array herds{std::vector<Creature>(600), std::vector<Creature>(400)};
    std::array<std::optional<bend::BodyFile>, 2> files;
    std::array<std::vector<glm::vec3>, 2> vertices;
    std::array<bend::Batch, 2> batches;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        bend::BodyFileFault fault;
        files[i] = bend::load_file(argv[i + 1], &fault);
        if (!files[i]) return std::printf("%s: %s\n", argv[i + 1], bend::describe(fault).c_str()), 1;
        const bend::Body& body = files[i]->levels[0].body;
        if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;
        for (std::size_t k = 0; k < herds[i].size(); ++k) herds[i][k].model[3].x = 3 * static_cast<float>(k);
        vertices[i].resize(herds[i].size() * body.vertex_count());
        batches[i] = {.body = &body, .count = herds[i].size(), .vertex_step = body.vertex_count()};
        batches[i].poses = strided(std::span(herds[i]), &Creature::pose);
        batches[i].transforms = strided(std::span(herds[i]), &Creature::model);
        batches[i].positions = interleaved<3>(&vertices[i][0].x, vertices[i].size());
    }
    const bend::CrowdJob crowd{.batches = batches};
    if (const bend::Fault bad = bend::validate(crowd); !bad.none())
        return std::printf("%s\n", bend::describe(bad).c_str()), 1;

    // In every frame: the game moves its creatures, one call bends them all, and the GPU gets the vertices.
    for (int frame = 0; frame < 3; ++frame) {
        for (std::vector<Creature>& herd : herds)
            for (Creature& creature : herd) creature.pose.angle = 0.25f * static_cast<float>(frame);
        const bend::CrowdResult result = bend::run_parallel(crowd);
        std::printf("frame %d: %zu creatures", frame, result.deformed);
        for (const std::vector<glm::vec3>& all : vertices) {
            float top = 0;
            for (const glm::vec3& vertex : all) top = std::max(top, vertex.z);
            std::printf(", up to %.2f high", static_cast<double>(top));
        }
        std::puts("");
    }
}
