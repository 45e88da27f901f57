// SPDX-License-Identifier: MIT
#include "attributes.hpp"
#include "morph.hpp"
#include "references.hpp"

#include <glm/geometric.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace goffer::mesh::gltf {

namespace {

/// Calls visit(number) for each number in a list that is one of `count` entries. What is not shown was not
/// checked.
template <class Visit>
void each_number(const Json& owner, const char* key, std::size_t count, const Visit& visit) {
    each(owner, key, [&](const Json& entry) {
        const std::optional<std::size_t> index = index_in(entry);
        if (index && *index < count) visit(*index);
    });
}

/// Of each node, whether it is another's child.
std::vector<bool> children_of(const Json& json) {
    std::vector<bool> is_child(json["nodes"].size(), false);
    each(json, "nodes", [&](const Json& node) {
        each_number(node, "children", is_child.size(), [&](std::size_t child) { is_child[child] = true; });
    });
    return is_child;
}

std::size_t number_of_shown_scene(const Json& json) {
    return json.contains("scene") ? json["scene"].get<std::size_t>() : 0;
}

/// Which scenes show a node: those that list the root above it, and the one that is shown by default.
class Scenes {
public:
    /// Makes the default scene where the document has none.
    explicit Scenes(Json& json) : json_(json), root_(json["nodes"].size()) {
        static_cast<void>(shown_scene(json));
        std::iota(root_.begin(), root_.end(), std::size_t{0});
        const std::vector<bool> is_child = children_of(json);
        for (std::size_t n = 0; n < root_.size(); ++n)
            if (!is_child[n]) set_root(n);
        for (std::size_t s = 0; s < json["scenes"].size(); ++s)
            each_number(json["scenes"][s], "nodes", root_.size(),
                        [&](std::size_t node) { listing_[node].insert(s); });
    }

    /// Lists a new node in all scenes that show the old one.
    void add(std::size_t node, std::size_t old) const {
        std::set<std::size_t> scenes{number_of_shown_scene(json_)};
        if (const auto known = listing_.find(root_[old]); known != listing_.end())
            scenes.insert(known->second.begin(), known->second.end());
        for (const std::size_t s : scenes) json_["scenes"][s]["nodes"].push_back(node);
    }

private:
    void set_root(std::size_t root) {
        std::vector<std::size_t> open{root};
        while (!open.empty()) {
            const std::size_t node = open.back();
            open.pop_back();
            root_[node] = root;
            each_number(json_["nodes"][node], "children", root_.size(), [&](std::size_t child) {
                if (root_[child] != root) open.push_back(child);
            });
        }
    }

    Json& json_;
    std::vector<std::size_t> root_;                         // of each node
    std::map<std::size_t, std::set<std::size_t>> listing_;  // scenes, by the nodes that they list
};

Json rotation_of(const Eigen::Quaterniond& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

/// A matrix as transforms of a node and of its only child: a shift, a turn and a scale, and before them
/// another turn. (One node's transform cannot shear, nor may its matrix.)
struct TwoTransforms {
    explicit TwoTransforms(const glm::dmat4& matrix) {
        Eigen::Matrix3d linear;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) linear(r, c) = matrix[c][r];
        // The singular value decomposition, of turns: a mirror is in the sign of the last scale.
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(linear.transpose() * linear);
        Eigen::Matrix3d first = solver.eigenvectors().rowwise().reverse();  // the longest axis first
        if (first.determinant() < 0) first.col(2) = -first.col(2);
        const Eigen::Matrix3d axes = linear * first;
        Eigen::Matrix3d last;
        last.col(0) = axes.col(0).stableNormalized();
        const Eigen::Vector3d second = axes.col(1) - last.col(0).dot(axes.col(1)) * last.col(0);
        last.col(1) = second.norm() > 1e-12 * axes.col(0).norm() ? second.stableNormalized()
                                                                 : last.col(0).unitOrthogonal();
        last.col(2) = last.col(0).cross(last.col(1));
        const Eigen::Vector3d scale = (last.transpose() * axes).diagonal();
        parent = {{"translation", {matrix[3][0], matrix[3][1], matrix[3][2]}},
                  {"rotation", rotation_of(Eigen::Quaterniond(last))},
                  {"scale", {scale[0], scale[1], scale[2]}}};
        child = {{"rotation", rotation_of(Eigen::Quaterniond(first.transpose()))}};
    }

    Json parent, child;
};

/// Whether the columns of a matrix are far from orthogonal.
bool shears(const glm::dmat4& matrix) {
    constexpr double most = 1e-5;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 a(matrix[i]), b(matrix[(i + 1) % 3]);
        if (std::abs(glm::dot(a, b)) > most * glm::length(a) * glm::length(b)) return true;
    }
    return false;
}

/// The node that a mesh moves to, and one above it that places it, if it has to be placed.
struct NewNodes {
    Json own, parent;
};

NewNodes nodes_at(const glm::dmat4& place) {
    if (place == glm::dmat4(1.0)) return {Json::object(), nullptr};
    if (shears(place)) {
        const TwoTransforms both(place);
        return {both.child, both.parent};
    }
    Json matrix = Json::array();
    for (int i = 0; i < 16; ++i) matrix.push_back(place[i / 4][i % 4]);
    return {Json::object(), {{"matrix", std::move(matrix)}}};
}

/// Without its skin a mesh would stand where its node does, rather than where its joints placed it. So it
/// moves to a new node at `place`, which its parent has, since a node that is animated must have no matrix.
/// Returns that node.
std::size_t unskin(Json& json, MeshUsers& users, const Scenes& scenes, std::size_t node,
                   const glm::dmat4& place) {
    const std::size_t mesh = users.claim(node);
    each(json["meshes"][mesh], "primitives", [](Json& primitive) {
        Json kept = Json::object();
        for (const auto& [name, accessor] : primitive["attributes"].items())
            if (!is_of_skin(name)) kept[name] = accessor;
        primitive["attributes"] = std::move(kept);
    });
    auto [moved, parent] = nodes_at(place);
    moved["mesh"] = mesh;
    Json& old = json["nodes"][node];
    if (old.contains("name")) moved["name"] = old["name"];
    if (old.contains("weights")) moved["weights"] = old["weights"];
    for (const char* key : {"mesh", "skin", "weights"}) old.erase(key);
    json["nodes"].push_back(std::move(moved));
    const std::size_t number = json["nodes"].size() - 1;
    if (!parent.is_null()) {
        parent["children"] = {number};
        json["nodes"].push_back(std::move(parent));
    }
    scenes.add(json["nodes"].size() - 1, node);
    return number;
}

/// Skins stay for nodes of other scenes alone.
void drop_unused_skins(Json& json) {
    bool used = false;
    each(json, "nodes", [&](const Json& node) { used = used || node.contains("skin"); });
    if (!used) json.erase("skins");
}

}  // namespace

MeshUsers::MeshUsers(Json& json) : json_(json) {
    each(json, "nodes", [&](const Json& node) {
        visit_member(node, "mesh", [&](const Json& index) {
            if (const std::optional<std::size_t> mesh = index_in(index)) ++users_[*mesh];
        });
    });
}

std::size_t MeshUsers::claim(std::size_t node) {
    const auto mesh = json_["nodes"][node]["mesh"].get<std::size_t>();
    if (users_[mesh] == 1) return mesh;
    --users_[mesh];
    Json copy = json_["meshes"][mesh];
    json_["meshes"].push_back(std::move(copy));
    const std::size_t own = json_["meshes"].size() - 1;
    json_["nodes"][node]["mesh"] = own;
    users_[own] = 1;
    return own;
}

Json& shown_scene(Json& json) {
    if (!json.contains("scenes") || !json["scenes"].is_array() || json["scenes"].empty()) {
        const std::vector<bool> is_child = children_of(json);
        Json roots = Json::array();
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) roots.push_back(i);
        Json scene = Json::object();
        scene["nodes"] = std::move(roots);
        json["scenes"] = Json::array();
        json["scenes"].push_back(std::move(scene));
        json["scene"] = 0;
    }
    return json["scenes"][number_of_shown_scene(json)];
}

std::vector<std::string> let_go_of_motion(Json& json, MeshUsers& users, std::vector<Block>& blocks) {
    std::vector<std::string> warnings;
    if (json.contains("animations") && !json["animations"].empty())
        warnings.emplace_back("the file's own animations are left out: the clip takes their place");
    json.erase("animations");
    const auto skinned = [&](const Block& block) { return json["nodes"][block.node].contains("skin"); };
    if (std::ranges::none_of(blocks, skinned)) return warnings;
    warnings.emplace_back("the file's own skins are left out: the clip moves what they would move");
    const Scenes scenes(json);
    std::map<std::size_t, std::size_t> moved;
    for (Block& block : blocks) {
        if (const auto known = moved.find(block.node); known != moved.end()) {
            block.node = known->second;
        } else if (skinned(block)) {
            const std::size_t node = unskin(json, users, scenes, block.node, block.placement.matrix());
            moved.emplace(block.node, node);
            block.node = node;
        }
        block.mesh = json["nodes"][block.node]["mesh"].get<std::size_t>();
    }
    drop_unused_skins(json);
    return warnings;
}

}  // namespace goffer::mesh::gltf
