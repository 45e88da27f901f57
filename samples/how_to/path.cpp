// SPDX-License-Identifier: MIT

// How do I lay a body along a path? path FILE.goffer (of several regions, the more the closer)

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/path.hpp>

#include <cmath>
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
    if (argc != 2) return std::puts("usage: path FILE.goffer"), 2;
    try {
        const bend::BodyFile file = load(argv[1]);
        const bend::Body& body = file.levels[0].body;
        const auto length = static_cast<float>(body.length());
        std::vector<glm::vec3> points;  // any polyline, in the body's unit: here a wave
        for (int i = 0; i <= 40; ++i) {
            const float t = static_cast<float>(i) / 40;
            points.emplace_back(length * t, 0.1f * length * std::sin(6 * t), 0);
        }
        if (const bend::PathFault fault = bend::check_path(points); fault != bend::PathFault::none)
            throw std::runtime_error(std::string(bend::describe(fault)));

        std::vector<bend::Pose> poses(body.region_count());
        const bend::PathFit fit = bend::poses_along(body, points, poses);
        std::vector<glm::vec3> positions(body.vertex_count());
        bend::DeformJob job{.body = &body, .poses = poses, .transform = fit.transform};
        job.positions = interleaved<3>(&positions[0].x, positions.size());
        bend::run(job);
        std::printf("%zu regions, off the path by %.1f %% of the length%s\n", poses.size(),
                    static_cast<double>(100 * fit.error / length),
                    fit.clamped ? ", as far as they bend" : "");
    } catch (const std::exception& error) {
        return std::printf("%s\n", error.what()), 1;
    }
}
