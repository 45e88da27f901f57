// SPDX-License-Identifier: MIT

// How do I tie a hat to a body, and let things bump into it? sockets_and_capsules FILE.goffer

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/capsules.hpp>
#include <goffer/bend/sockets.hpp>

#include <array>
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
    if (argc != 2) return std::puts("usage: sockets_and_capsules FILE.goffer"), 2;
    try {
        const bend::BodyFile file = load(argv[1]);
        const bend::Body& body = file.levels[0].body;
        const std::vector<bend::Pose> poses(body.region_count(), {.angle = 0.5f});
        const bend::DeformJob instance{.body = &body, .poses = poses};

        // Sockets were placed by goffer bake --socket NAME=X,Y,Z, or are by fit::socket_near.
        std::vector<bend::Socket> places;
        for (const bend::NamedSocket& socket : file.sockets) places.push_back(socket.socket);
        const std::optional<bend::Sockets> sockets = bend::Sockets::make(body, places);
        if (!sockets) throw std::runtime_error("there is no socket in this file");
        std::vector<bend::SocketFrame> frames(sockets->count());
        sockets->frames(instance, frames);  // in every frame; the mesh is not touched
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const glm::vec3 at = frames[i].position;
            std::printf("%.*s: %.2f %.2f %.2f\n", static_cast<int>(file.sockets[i].name.size()),
                        file.sockets[i].name.data(), static_cast<double>(at.x), static_cast<double>(at.y),
                        static_cast<double>(at.z));
        }

        // Capsules hold every vertex, wrinkles and all.
        constexpr std::size_t pieces = 4;
        std::vector<bend::Capsule> capsules(bend::capsule_count(body, pieces));
        bend::capsules(instance, pieces, capsules);
        std::printf("%zu capsules, the first of radius %.2f\n", capsules.size(),
                    static_cast<double>(capsules[0].radius));
    } catch (const std::exception& error) {
        return std::printf("%s\n", error.what()), 1;
    }
}
