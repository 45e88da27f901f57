// SPDX-License-Identifier: MIT

// How do I load bodies, and reload one while the game runs? body_file FILE.goffer NEWER.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_table.hpp>
#include <goffer/bend/job.hpp>

#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 3) return std::puts("usage: body_file FILE.goffer NEWER.goffer"), 2;
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);  // bend::load uses a mapped one
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;

    // Instances keep a handle, never an address.
    bend::BodyTable bodies;
    const bend::BodyHandle worm = bodies.add(std::move(file->levels[0].body));
    std::vector<float> vertices;
    std::uint32_t built = 0;  // the revision that buffers were made for
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
            vertices.assign(3 * body.vertex_count(), 0);
            std::printf("to draw: %zu triangles, %zu sockets\n", file->levels[0].mesh.triangles.size() / 3,
                        file->sockets.size());
        }
        const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.1f * static_cast<float>(frame)});
        bend::DeformJob job{.body = &body, .poses = poses};
        job.positions = interleaved<3>(vertices.data(), body.vertex_count());
        bend::run(job);
        std::printf("frame %d: revision %u, %zu vertices\n", frame, built, body.vertex_count());
    }
    bodies.remove(worm);
    std::printf("removed: %s\n", bodies.find(worm) == nullptr ? "the handle names nothing" : "still there");
}
