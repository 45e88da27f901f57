// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/refine.hpp>
#include <goffer/mesh/refined.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Refines meshes, and examines the results.

namespace goffer::test {

/// A refinement of fit, as a subdivision of mesh.
struct MeshRecipe {
    fit::Refinement made;
    std::vector<mesh::EdgeVertex> vertices;

    [[nodiscard]] mesh::Subdivision pieces() const { return {vertices, made.triangles, made.parents}; }
};

/// Cuts for 16 rows a fold along x, y or z.
inline MeshRecipe recipe(const mesh::Mesh& mesh, int axis, int folds = 1) {
    std::vector<double> heights;
    for (const glm::vec3& p : mesh.positions) heights.push_back(static_cast<double>(p[axis]));
    const auto [low, high] = std::ranges::minmax(heights);
    for (double& z : heights) z -= low;
    const fit::Stretch whole{high - low, static_cast<double>(folds)};
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    MeshRecipe recipe;
    recipe.made = fit::refine({mesh.positions, triangles}, heights, {&whole, 1});
    for (const auto& [a, b, t] : recipe.made.vertices) recipe.vertices.push_back({a, b, t});
    return recipe;
}

inline mesh::Mesh refined_along(const mesh::Mesh& mesh, int axis, int folds = 1) {
    return mesh::refined(mesh, recipe(mesh, axis, folds).made);
}

/// The mesh without the file that it came from, so that new vertices are behind all others.
inline mesh::Mesh without_its_file(mesh::Mesh mesh) {
    mesh.source = nullptr;
    return mesh;
}

/// Cuts every edge in half, whatever the mesh; a triangle without three corners stays.
inline MeshRecipe halves(const mesh::Mesh& mesh) {
    MeshRecipe recipe;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    const auto half = [&](std::uint32_t a, std::uint32_t b) {
        const auto next = static_cast<std::uint32_t>(mesh.positions.size() + recipe.vertices.size());
        const auto [entry, is_new] = known.try_emplace(std::minmax(a, b), next);
        if (is_new) recipe.vertices.push_back({std::min(a, b), std::max(a, b), 0.5});
        return entry->second;
    };
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) {
        const std::uint32_t a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
        std::vector<std::uint32_t> pieces{a, b, c};
        if (a != b && b != c && c != a) {
            const std::uint32_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
            pieces = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
        }
        recipe.made.triangles.insert(recipe.made.triangles.end(), pieces.begin(), pieces.end());
        recipe.made.parents.insert(recipe.made.parents.end(), pieces.size() / 3, t);
    }
    return recipe;
}

/// The same of the result: new vertices between new vertices. As one recipe for `mesh`.
inline MeshRecipe quarters(const mesh::Mesh& mesh) {
    MeshRecipe first = halves(mesh);
    const MeshRecipe second = halves(mesh::refined(without_its_file(mesh), first.pieces()));
    MeshRecipe all;
    all.vertices = first.vertices;
    all.vertices.insert(all.vertices.end(), second.vertices.begin(), second.vertices.end());
    all.made.triangles = second.made.triangles;
    for (const std::uint32_t parent : second.made.parents)
        all.made.parents.push_back(first.made.parents[parent]);
    return all;
}

/// How many edges run more often one way than the other, with vertices of the same position, bit for bit,
/// taken as one. 0 for a closed surface.
inline std::size_t open_edges(const mesh::Mesh& mesh) {
    using Place = std::array<std::uint32_t, 3>;
    const auto place = [&](std::uint32_t vertex) {
        const glm::vec3 q = mesh.positions[vertex] + 0.0f;
        return Place{std::bit_cast<std::uint32_t>(q.x), std::bit_cast<std::uint32_t>(q.y),
                     std::bit_cast<std::uint32_t>(q.z)};
    };
    std::map<std::pair<Place, Place>, int> runs;
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Place a = place(triangles[t + i]), b = place(triangles[t + (i + 1) % 3]);
            if (a < b) ++runs[{a, b}];
            if (b < a) --runs[{b, a}];
        }
    }
    const auto open = [](const auto& run) { return run.second != 0; };
    return static_cast<std::size_t>(std::ranges::count_if(runs, open));
}

/// The value of a corner, zero where it has none.
template <class T>
T corner_value(const mesh::Mesh& mesh, const mesh::Attribute<T>& attribute, std::size_t corner) {
    if (attribute.empty()) return T(0.0f);
    const std::uint32_t index = attribute.per_vertex() ? mesh.corners[corner] : attribute.corners[corner];
    return index == mesh::Attribute<T>::none ? T(0.0f) : attribute.values[index];
}

}  // namespace goffer::test
