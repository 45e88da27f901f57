// SPDX-License-Identifier: MIT

// How do I bend a mesh of my own? Bind its arrays once, and run a job: bind_and_bend

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace goffer;

int main() {
    // Your mesh: here a tube of 24 columns and 81 rows, 10 long, along z.
    constexpr std::uint32_t columns = 24, rows = 81;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < columns * rows; ++i) {
        const float beta = 6.2831853f * static_cast<float>(i % columns) / columns;
        positions.emplace_back(std::cos(beta), std::sin(beta),
                               10.0f * static_cast<float>(i / columns) / (rows - 1));
        const std::uint32_t a = i, b = i % columns + 1 < columns ? i + 1 : i + 1 - columns;
        if (i / columns + 1 < rows)
            triangles.insert(triangles.end(), {a, b, a + columns, b, b + columns, a + columns});
    }

    // Once, offline or while loading.
    const fit::Geometry geometry{positions, triangles};
    const fit::Binding binding = fit::bind(geometry, fit::fit_cylinder(geometry));

    // In every frame. Normals come too, whether the mesh had any or not.
    struct Vertex {
        glm::vec3 position, normal;
    };
    std::vector<Vertex> vertices(binding.body.vertex_count());
    bend::DeformJob job{.body = &binding.body, .pose = {.angle = 1.5f, .direction = 0.0f}};
    job.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(Vertex));
    job.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(Vertex));
    if (const bend::Fault fault = bend::validate(job); !fault.none())
        return std::puts(bend::describe(fault).c_str()), 1;
    bend::run(job);

    const glm::vec3 tip = vertices.back().position;
    std::printf("the last vertex went from 1.0 0.0 10.0 to %.1f %.1f %.1f\n", static_cast<double>(tip.x),
                static_cast<double>(tip.y), static_cast<double>(tip.z));
}
