// SPDX-License-Identifier: MIT

// How do I tie a hat to a body, and let things bump into it? sockets_and_capsules FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/capsules.hpp>
#include <goffer/bend/sockets.hpp>

#include <array>
#include <cstdio>
#include <optional>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: sockets_and_capsules FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.5f});
    const bend::DeformJob instance{.body = &body, .poses = poses};

    // Sockets were placed by goffer bake --socket NAME=X,Y,Z, or are by fit::socket_near.
    const std::optional<bend::Sockets> sockets = bend::Sockets::make(body, file->sockets);
    if (!sockets) return std::puts("there is no socket in this file"), 1;
    std::vector<bend::SocketFrame> frames(sockets->count());
    sockets->frames(instance, frames);  // in every frame; the mesh is not touched
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const glm::vec3 at = frames[i][3];  // frames[i] takes the hat to the body
        std::printf("%.*s: %.2f %.2f %.2f\n", static_cast<int>(file->sockets[i].name.size()),
                    file->sockets[i].name.data(), static_cast<double>(at.x), static_cast<double>(at.y),
                    static_cast<double>(at.z));
    }

    // Capsules hold every vertex, wrinkles and all.
    constexpr std::size_t pieces = 4;
    std::vector<bend::Capsule> capsules(bend::capsule_count(body, pieces));
    bend::capsules(instance, pieces, capsules);
    std::printf("%zu capsules, the first of radius %.2f\n", capsules.size(),
                static_cast<double>(capsules[0].radius));
}
