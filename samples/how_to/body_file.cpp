// SPDX-License-Identifier: MIT

// How do I load bodies, and reload one between two frames of a crowd? body_file FILE.goffer NEWER.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_table.hpp>
#include <goffer/bend/crowd.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 3) return std::puts("usage: body_file FILE.goffer NEWER.goffer"), 2;
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);  // mapped_file.cpp maps one
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;

    // The crowd keeps a handle, never an address.
    bend::BodyTable bodies;
    const bend::BodyHandle worm = bodies.add(std::move(file->levels[0].body));
    constexpr std::size_t worms = 100;
    std::vector<bend::Pose> poses;
    std::vector<glm::vec3> vertices;
    std::uint32_t built = 0;  // the revision that vertices are of
    for (int frame = 0; frame < 4; ++frame) {
        if (frame == 2) {
            // The artist has baked it anew: between two frames it takes the old one's place. The file stays,
            // with what is drawn of the body.
            std::optional<bend::BodyFile> newer = bend::load_file(argv[2], &fault);
            if (!newer) return std::printf("%s: %s\n", argv[2], bend::describe(fault).c_str()), 1;
            bodies.replace(worm, std::move(newer->levels[0].body));
            file = std::move(newer);
        }
        const bend::Body& body = *bodies.find(worm);
        if (bodies.revision(worm) != built) {
            built = bodies.revision(worm);
            vertices.resize(worms * body.vertex_count());
            std::printf("to draw: %zu triangles, %zu sockets\n", file->levels[0].mesh.triangles.size() / 3,
                        file->sockets.size());
        }
        poses.assign(worms * body.region_count(), {.angle = 0.2f * static_cast<float>(frame)});
        bend::Batch batch{.body = &body, .count = worms, .vertex_step = body.vertex_count()};
        batch.poses = {.data = poses.data(), .count = worms};
        batch.poses.stride *= static_cast<std::uint32_t>(body.region_count());
        batch.positions = interleaved<3>(&vertices[0].x, vertices.size());
        const bend::CrowdResult result = bend::run_parallel({.batches = {&batch, 1}});
        float top = 0;
        for (const glm::vec3& vertex : vertices) top = std::max(top, vertex.z);
        std::printf("frame %d: revision %u, %zu worms of %zu vertices, up to %.2f high\n", frame, built,
                    result.deformed, body.vertex_count(), static_cast<double>(top));
    }
    bodies.remove(worm);
    std::printf("removed: %s\n", bodies.find(worm) == nullptr ? "the handle names nothing" : "still there");
}
