// SPDX-License-Identifier: MIT

// What a game's asset pipeline does: fits a cylinder to a mesh and binds it.

#include <goffer/fit/bind.hpp>
#include <goffer/paper/base.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
    const goffer::paper::BaseMesh base = goffer::paper::base_mesh(10, 1, 48, 65, true);
    const std::vector<glm::vec3> positions(base.positions.begin(), base.positions.end());
    const goffer::fit::Geometry geometry{.positions = positions, .triangles = base.triangles};
    const goffer::fit::Cylinder cylinder = goffer::fit::fit_cylinder(geometry);
    const goffer::fit::Binding binding = goffer::fit::bind(geometry, cylinder);

    std::printf("length %g, radius %g, %d folds\n", cylinder.length, cylinder.radius, binding.folds());
    const bool fits = std::abs(cylinder.length - 10) < 0.01 && std::abs(cylinder.radius - 1) < 0.01;
    return fits && binding.body.vertex_count() == positions.size() ? 0 : 1;
}
