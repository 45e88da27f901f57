// SPDX-License-Identifier: MIT

// How do I load bodies, and reload one while the game runs? body_file FILE.goffer NEWER.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_table.hpp>
#include <goffer/bend/job.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace goffer;

bend::BodyFile load(const char* name) {
    std::ifstream in(name, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> file = bend::load_copy(std::as_bytes(std::span(bytes)), &fault);
    if (!file) throw std::runtime_error(bend::describe(fault).c_str());
    return std::move(*file);
}

int main(int argc, char** argv) {
    if (argc != 3) return std::puts("usage: body_file FILE.goffer NEWER.goffer"), 2;
    try {
        // Instances keep a handle, never an address. A mapped file needs no copy: see bend::load.
        bend::BodyTable bodies;
        bend::BodyFile file = load(argv[1]);
        std::printf("%zu triangles, %zu sockets\n", file.levels[0].mesh.triangles.size() / 3,
                    file.sockets.size());
        const bend::BodyHandle worm = bodies.add(std::move(file.levels[0].body));
        std::vector<float> vertices;
        std::uint32_t built = 0;  // the revision that the vertex buffer was made for
        for (int frame = 0; frame < 4; ++frame) {
            // The artist has baked it anew: between two frames it takes the old one's place.
            if (frame == 2) bodies.replace(worm, std::move(load(argv[2]).levels[0].body));
            const bend::Body& body = *bodies.find(worm);
            if (bodies.revision(worm) != built) {
                built = bodies.revision(worm);
                vertices.assign(3 * body.vertex_count(), 0);
            }
            const std::vector<bend::Pose> poses(body.region_count(),
                                                {.angle = 0.1f * static_cast<float>(frame)});
            bend::DeformJob job{.body = &body, .poses = poses};
            job.positions = interleaved<3>(vertices.data(), body.vertex_count());
            bend::run(job);
            std::printf("frame %d: revision %u, %zu vertices\n", frame, built, body.vertex_count());
        }
        bodies.remove(worm);
        std::printf("removed: %s\n",
                    bodies.find(worm) == nullptr ? "the handle names nothing" : "still there");
    } catch (const std::exception& error) {
        return std::printf("%s\n", error.what()), 1;
    }
}
