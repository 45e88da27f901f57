// SPDX-License-Identifier: MIT
#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>

#include <cstdio>
#include <exception>

int main() try {
    using namespace goffer;
    const mesh::Mesh model = mesh::load("worm.glb");
    mesh::VertexArrays shape = mesh::vertex_arrays(model);
    const fit::Geometry geometry{shape.positions, shape.triangles, shape.normals};
    const fit::Binding worm = fit::bind(geometry, fit::fit_cylinder(geometry));  // once, offline
    if (worm.folds() == 0) std::puts("no folds: the mesh is too coarse, see samples/how_to/refine.cpp");
    bend::DeformJob job{.body = &worm.body, .pose = {.angle = 1.5f, .direction = 0.5f}};  // in radians
    job.positions = interleaved<3>(&shape.positions[0].x, shape.positions.size());
    if (!shape.normals.empty()) job.normals = interleaved<3>(&shape.normals[0].x, shape.normals.size());
    bend::run(job);  // every frame: allocates nothing
    mesh::save(mesh::with_vertex_arrays(model, shape), "bent.glb");
} catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
}
