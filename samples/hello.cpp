// SPDX-License-Identifier: MIT
#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>

int main(int count, char** words) {
    using namespace goffer;
    if (count != 3) return 2;  // hello MODEL OUTPUT
    const mesh::Mesh model = mesh::load(words[1]);
    mesh::Records shape = mesh::records(model);
    const fit::Geometry geometry{shape.positions, shape.triangles, shape.normals};
    const fit::Bound worm = fit::bind(geometry, fit::fit_cylinder(geometry));  // once, offline
    shape.normals.resize(shape.positions.size());

    bend::DeformJob job{.body = &worm.body, .pose = {.angle = 1.5f, .direction = 0.5f}};  // radians
    job.positions = interleaved<3>(&shape.positions[0].x, shape.positions.size());
    job.normals = interleaved<3>(&shape.normals[0].x, shape.normals.size());
    bend::run(job);  // every frame: no allocation, no lock
    mesh::save(mesh::with_records(model, shape), words[2]);
}
