// SPDX-License-Identifier: MIT
#include "support/files.hpp"

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

using namespace goffer;
namespace fs = std::filesystem;

namespace {

mesh::Mesh written(const char* name) {
    const test::Folder folder;
    const std::string command = "\"" GOFFER_CATERPILLAR "\" \"" + (folder / name).string() + "\"";
    REQUIRE(std::system(command.c_str()) == 0);
    return mesh::load(folder / name);
}

}  // namespace

TEST_CASE("the caterpillar is whole") {
    const mesh::Mesh m = written("a.obj");
    CHECK(m.positions.size() >= 9000);
    CHECK(m.positions.size() <= 11000);
    CHECK(m.materials.size() >= 4);
    CHECK(!m.normals.empty());
    REQUIRE(!m.uvs.empty());

    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0;
    for (std::size_t i = 0; i < m.corners.size(); i += 3) {
        glm::dvec3 p[3];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = m.positions[m.corners[i + k]];
            ++edges[{m.corners[i + k], m.corners[i + (k + 1) % 3]}];
        }
        REQUIRE(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) > 1e-8);
        volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
    }
    CHECK(volume > 0.02);  // about pi r^2 L: the outside is out
    CHECK(volume < 0.04);
    for (const auto& [edge, count] : edges) {
        REQUIRE(count == 1);
        REQUIRE(edges.count({edge.second, edge.first}) == 1);  // watertight, trunk and pieces
    }
}

TEST_CASE("the caterpillar has the same vertices in any format") {
    const std::size_t vertices = written("a.obj").positions.size();
    CHECK(written("a.glb").positions.size() == vertices);
    CHECK(written("a.ply").positions.size() == vertices);
}

TEST_CASE("the trunk has the rows that five folds need") {
    const mesh::Mesh m = written("a.ply");
    for (int slab = 0; slab < 80; ++slab) {  // 8 rows per fold, 5 folds per half length
        const float low = 0.998f * static_cast<float>(slab) / 80,
                    high = 0.998f * static_cast<float>(slab + 1) / 80;
        const auto inside = [&](const glm::vec3& p) { return p.z >= low && p.z < high; };
        CHECK(std::ranges::count_if(m.positions, inside) >= 44);
    }
}
