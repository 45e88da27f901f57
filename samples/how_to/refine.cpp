// SPDX-License-Identifier: MIT

// How do I give a mesh of my own the vertices that its folds need? refine

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/refine.hpp>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace goffer;

int main() {
    // Your mesh: here a tube of 8 columns and 9 rows, 10 long, along z.
    constexpr std::uint32_t columns = 8, rows = 9;
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
    const fit::BindOptions options;
    const fit::Geometry coarse{positions, triangles};
    // With the body's shape, since folds are as long as suits its radius where they are.
    const fit::Cylinder cylinder = fit::fit_shape(coarse, fit::fit_cylinder(coarse));
    std::printf("%zu vertices: %d folds\n", positions.size(), fit::bind(coarse, cylinder, options).folds());

    const fit::Refinement cuts = fit::refine(coarse, cylinder, fit::stretches_of(cylinder, options));
    const std::vector<glm::vec3> normals = fit::make_refined_normals(positions, triangles, cuts);
    positions = fit::refined_positions(positions, cuts);
    std::vector<glm::vec2> uvs(positions.size());  // and what else a vertex has: the first ones are yours
    for (std::size_t i = 0; i < cuts.vertices.size(); ++i) {
        const auto [a, b, t] = cuts.vertices[i];
        uvs[uvs.size() - cuts.vertices.size() + i] = glm::mix(uvs[a], uvs[b], static_cast<float>(t));
    }
    const fit::Geometry fine{positions, cuts.triangles, normals};
    const fit::Binding binding = fit::bind(fine, cylinder, options);
    std::printf("%zu vertices: %d folds\n", positions.size(), binding.folds());
}
