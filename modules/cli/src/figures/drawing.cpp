// SPDX-License-Identifier: MIT
#include "figures/drawing.hpp"

#include "figures/figure.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/renderer.hpp>
#include <goffer/measure/timer.hpp>

#include <array>

namespace goffer::cli {
namespace {

constexpr int warm_up_draws = 10;

draw::OrbitCamera camera_on(const bend::Body& body) {
    const glm::dmat3 axes = body.axes();
    draw::OrbitCamera camera(glm::vec3(axes[1] - 0.3 * axes[0]), glm::vec3(axes[0]));
    const float half = 0.5f * static_cast<float>(body.length());
    camera.look_at(glm::vec3(body.origin()) + half * glm::vec3(axes[2]), 1.2f * half,
                   float{drawn_width} / float{drawn_height});
    return camera;
}

}  // namespace

std::optional<std::vector<double>> drawing_times(const bend::Body& body,
                                                 std::span<const std::uint32_t> triangles,
                                                 const std::function<bend::Pose(std::size_t)>& pose, int runs,
                                                 int frames, std::string& device) try {
    const draw::OffscreenContext context(draw::OffscreenContext::Api::core33, device);
    if (!context) return std::nullopt;
    const draw::OffscreenTarget target(drawn_width, drawn_height);
    draw::Renderer renderer;
    device = renderer.device();
    const std::array parts{draw::Part{0, static_cast<std::uint32_t>(triangles.size() / 3)}};
    draw::Mesh mesh(body, triangles, parts);
    const draw::OrbitCamera camera = camera_on(body);
    std::vector<draw::Vertex> vertices(body.vertex_count());
    bend::DeformJob job{.body = &body};
    job.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(draw::Vertex));
    job.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(draw::Vertex));
    const auto frames_take = [&](int count) {
        double sum = 0;
        for (int frame = 0; frame < count; ++frame) {
            job.pose = pose(static_cast<std::size_t>(frame));
            bend::run(job);
            sum += measure::nanoseconds_of(measure::wall_clock, [&] {
                mesh.set_vertices(vertices);
                renderer.begin(camera, {0, 0, drawn_width, drawn_height});
                renderer.draw(mesh);
                renderer.end();
                draw::OffscreenTarget::finish();
            });
        }
        return 1e-6 * sum / count;
    };
    (void)frames_take(warm_up_draws);
    std::vector<double> times;
    times.reserve(static_cast<std::size_t>(runs));
    for (int run = 0; run < runs; ++run) times.push_back(frames_take(frames));
    return times;
} catch (const draw::Error& error) {
    device = error.what();
    return std::nullopt;
}

}  // namespace goffer::cli
