// SPDX-License-Identifier: MIT

// How do I have a body walk along a path? path FILE.goffer (of several regions, the more the closer)

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/bend/path.hpp>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

using namespace goffer;

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: path FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const std::optional<bend::BodyFile> file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    const auto length = static_cast<float>(body.length());
    std::vector<glm::vec3> points;  // any polyline, in the body's unit: here a wave
    for (int i = 0; i <= 80; ++i) {
        const float t = static_cast<float>(i) / 40;
        points.emplace_back(length * t, 0.1f * length * std::sin(6 * t), 0);
    }
    if (const bend::PathFault bad = bend::check_path(points); bad != bend::PathFault::none)
        return std::printf("%s\n", std::string(bend::describe(bad)).c_str()), 1;

    std::vector<bend::Pose> poses(body.region_count());
    std::vector<glm::vec3> positions(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    // Its back, here a side of the model, stays up. In space, where there is no up, set `before` to
    // glm::mat3(fit.transform) of the frame before.
    bend::PathStart start{.model_up = glm::vec3(body.axes()[0]), .up = {0, 0, 1}};
    for (int frame = 0; frame <= 20; ++frame) {
        start.distance = length * static_cast<float>(frame) / 20;
        const bend::PathFit fit = bend::poses_along(body, points, poses, start);
        job.transform = fit.transform;
        bend::run(job);
        if (frame % 10 == 0)
            std::printf("frame %d: %zu regions, off the path by %.1f %% of the length%s\n", frame,
                        poses.size(), static_cast<double>(100 * fit.error / length),
                        fit.clamped ? ", as far as they bend" : "");
    }
    if (poses.size() < 4) std::puts("more regions come closer: goffer bake --regions");
}
