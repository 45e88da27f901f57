// SPDX-License-Identifier: MIT

// How do I deform a crowd in a shader? shader FILE.goffer. The shaders are in modules/gpu/README.md.

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <cstdio>
#include <span>
#include <vector>

using namespace goffer;

struct Worm {
    bend::Pose pose;
    glm::mat4x3 model{1};
};

int main(int argc, char** argv) {
    if (argc != 2) return std::puts("usage: shader FILE.goffer"), 2;
    bend::BodyFileFault fault;
    const auto file = bend::load_file(argv[1], &fault);
    if (!file) return std::printf("%s: %s\n", argv[1], bend::describe(fault).c_str()), 1;
    const bend::Body& body = file->levels[0].body;
    if (body.region_count() != 1) return std::puts("this program is for bodies of one region"), 1;

    // Once: a vertex buffer, with the attributes at these offsets, and a program that contains this text.
    const gpu::VertexLayout layout = gpu::vertex_layout(body);
    std::vector<std::byte> vertices(body.vertex_count() * layout.stride);
    gpu::write_vertices(body, vertices);
    std::printf("vertices: %zu bytes each; normals from byte %zu on; text: %zu bytes\n", layout.stride,
                layout.normal, gpu::deform_glsl().size());

    // In every frame: a buffer of the instances' rows, then one instanced draw. The mesh is not touched.
    std::vector<Worm> worms(1000);
    std::vector<bend::Coefficients> rows(worms.size() * body.region_count());
    bend::Batch batch{.body = &body, .count = worms.size()};
    batch.poses = strided(std::span(worms), &Worm::pose);
    batch.transforms = strided(std::span(worms), &Worm::model);
    for (int frame = 0; frame < 3; ++frame) {
        for (Worm& worm : worms) worm.pose.angle = 0.5f * static_cast<float>(frame);
        bend::set_up(batch, rows);
        std::printf("frame %d: %zu bytes to upload, curvature %.3f\n", frame, rows.size() * sizeof rows[0],
                    static_cast<double>(rows[0].curvature));
    }
}
