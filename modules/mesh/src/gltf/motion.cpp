// SPDX-License-Identifier: MIT
#include "morph.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace goffer::mesh::gltf {

namespace {

/// Without its skin a mesh would stand where its node does, rather than where its joints placed it. So it
/// moves to a new node at `place`, which its parent has, since a node that is animated must have no matrix.
/// Returns that node.
std::size_t unskin(Json& json, std::size_t node, const glm::dmat4& place) {
    const std::size_t mesh = claim_mesh(json, node);
    each(json["meshes"][mesh], "primitives", [](Json& primitive) {
        Json kept = Json::object();
        for (const auto& [name, accessor] : primitive["attributes"].items())
            if (!name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_")) kept[name] = accessor;
        primitive["attributes"] = std::move(kept);
    });
    Json moved = {{"mesh", mesh}};
    Json& old = json["nodes"][node];
    if (old.contains("name")) moved["name"] = old["name"];
    if (old.contains("weights")) moved["weights"] = old["weights"];
    for (const char* key : {"mesh", "skin", "weights"}) old.erase(key);
    json["nodes"].push_back(std::move(moved));
    const std::size_t number = json["nodes"].size() - 1;
    std::size_t root = number;
    if (place != glm::dmat4(1.0)) {
        Json parent = {{"children", {number}}, {"matrix", Json::array()}};
        for (int i = 0; i < 16; ++i) parent["matrix"].push_back(place[i / 4][i % 4]);
        json["nodes"].push_back(std::move(parent));
        root = number + 1;
    }
    shown_scene(json)["nodes"].push_back(root);
    return number;
}

/// Skins stay for nodes of other scenes alone.
void drop_unused_skins(Json& json) {
    bool used = false;
    each(json, "nodes", [&](const Json& node) { used = used || node.contains("skin"); });
    if (!used) json.erase("skins");
}

}  // namespace

std::size_t claim_mesh(Json& json, std::size_t node) {
    const auto mesh = json["nodes"][node]["mesh"].get<std::size_t>();
    std::size_t users = 0;
    each(json, "nodes", [&](const Json& other) {
        if (other.contains("mesh") && other["mesh"] == mesh) ++users;
    });
    if (users == 1) return mesh;
    Json copy = json["meshes"][mesh];
    json["meshes"].push_back(std::move(copy));
    const std::size_t own = json["meshes"].size() - 1;
    json["nodes"][node]["mesh"] = own;
    return own;
}

Json& shown_scene(Json& json) {
    if (!json.contains("scenes") || !json["scenes"].is_array() || json["scenes"].empty()) {
        std::set<std::size_t> children;
        each(json, "nodes", [&](const Json& node) {
            each(node, "children", [&](const Json& child) { children.insert(child.get<std::size_t>()); });
        });
        Json roots = Json::array();
        for (std::size_t i = 0; i < json["nodes"].size(); ++i)
            if (!children.contains(i)) roots.push_back(i);
        Json scene = Json::object();
        scene["nodes"] = std::move(roots);
        json["scenes"] = Json::array();
        json["scenes"].push_back(std::move(scene));
        json["scene"] = 0;
    }
    return json["scenes"][json.contains("scene") ? json["scene"].get<std::size_t>() : 0];
}

std::vector<std::string> let_go_of_motion(Json& json, std::vector<Block>& blocks) {
    std::vector<std::string> warnings;
    if (json.contains("animations") && !json["animations"].empty())
        warnings.emplace_back("the file's own animations are left out: the clip moves what they would move");
    json.erase("animations");
    std::map<std::size_t, std::size_t> moved;
    for (Block& block : blocks) {
        if (const auto known = moved.find(block.node); known != moved.end()) {
            block.node = known->second;
        } else if (json["nodes"][block.node].contains("skin")) {
            const std::size_t node = unskin(json, block.node, block.placement.matrix());
            moved.emplace(block.node, node);
            block.node = node;
        }
        block.mesh = json["nodes"][block.node]["mesh"].get<std::size_t>();
    }
    if (!moved.empty()) {
        warnings.emplace_back("the file's own skins are left out: the clip moves what they would move");
        drop_unused_skins(json);
    }
    return warnings;
}

}  // namespace goffer::mesh::gltf
