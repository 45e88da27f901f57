// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace goffer::mesh::gltf {

glm::dmat4 affine(glm::dmat4 matrix) {
    for (int i = 0; i < 4; ++i) matrix[i][3] = i == 3 ? 1.0 : 0.0;
    return matrix;
}

namespace {

glm::dmat4 local_matrix(const Value& node) {
    glm::dmat4 matrix(1.0);
    if (node.has("matrix")) {
        matrix = glm::make_mat4(node["matrix"].numbers(16).data());
        return affine(matrix);
    }
    if (node.has("rotation")) {
        const std::vector<double> q = node["rotation"].numbers(4);
        const glm::dquat rotation(q[3], q[0], q[1], q[2]);
        if (!(glm::length(rotation) > 1e-6))
            node["rotation"].fail("is not a unit quaternion; export the file again");
        matrix = glm::mat4_cast(glm::normalize(rotation));
    }
    if (node.has("scale")) {
        const std::vector<double> scale = node["scale"].numbers(3);
        for (int i = 0; i < 3; ++i) matrix[i] *= scale[static_cast<std::size_t>(i)];
    }
    if (node.has("translation")) {
        matrix[3] = glm::dvec4(glm::make_vec3(node["translation"].numbers(3).data()), 1.0);
    }
    return matrix;
}

/// Where the walk through the nodes starts: the roots of the default scene, or of all nodes where there is no
/// scene.
std::vector<std::size_t> roots(const Document& document) {
    const Value root = document.root();
    std::vector<std::size_t> found;
    if (document.count("scenes") > 0) {
        const Value scene =
            root.has("scene") ? document.entry("scenes", root["scene"]) : root["scenes"][std::size_t{0}];
        for (std::size_t i = 0; scene.has("nodes") && i < scene["nodes"].size(); ++i) {
            found.push_back(document.number("nodes", scene["nodes"][i]));
        }
        return found;
    }
    std::vector<bool> child(document.count("nodes"), false);
    for (std::size_t n = 0; n < child.size(); ++n) {
        const Value node = root["nodes"][n];
        for (std::size_t i = 0; node.has("children") && i < node["children"].size(); ++i) {
            child[document.number("nodes", node["children"][i])] = true;
        }
    }
    for (std::size_t n = 0; n < child.size(); ++n) {
        if (!child[n]) found.push_back(n);
    }
    if (found.empty() && !child.empty())
        root["nodes"].fail("every node is another's child, a cycle; export the file again");
    return found;
}

}  // namespace

std::vector<PlacedNode> nodes_of_scene(const Document& document) {
    std::vector<PlacedNode> order, open;
    std::vector<bool> seen(document.count("nodes"), false);
    const auto reach = [&](std::size_t node, const glm::dmat4& parent) {
        if (seen[node])  // before it takes memory once more
            document.root()["nodes"][node].fail(
                "is reached twice: a cycle, or a node with two parents; export the file again");
        seen[node] = true;
        open.push_back({node, parent});
    };
    for (const std::size_t node : roots(document)) reach(node, glm::dmat4(1.0));
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        PlacedNode next = open.back();
        open.pop_back();
        const Value node = document.root()["nodes"][next.node];
        next.world = next.world * local_matrix(node);
        order.push_back(next);
        for (std::size_t i = node.has("children") ? node["children"].size() : 0; i-- > 0;)
            reach(document.number("nodes", node["children"][i]), next.world);
    }
    return order;
}

}  // namespace goffer::mesh::gltf
