// SPDX-License-Identifier: MIT
#include "attributes.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace goffer::mesh::gltf {

std::string uv_name(std::size_t set) {
    return "TEXCOORD_" + std::to_string(set);
}

AccessorSet accessors_of(const Value& attributes) {
    constexpr std::size_t max_uv_sets = 16;
    AccessorSet set;
    const auto add = [&](const std::string& name) {
        set.push_back(attributes.has(name.c_str()) ? attributes[name.c_str()].whole() : Block::absent);
        return set.back() != Block::absent;
    };
    for (const char* name : stream_name) add(name);
    add("COLOR_0");
    for (std::size_t i = 0; i < max_uv_sets && add(uv_name(i)); ++i) {
    }
    while (set.size() > stream_count + 1 && set.back() == Block::absent) set.pop_back();
    return set;
}

std::uint64_t work_of(const Document& document, const Value& primitive) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const auto elements = [&](const Value& reference) {
        return std::min(document.entry("accessors", reference)["count"].whole(), most);
    };
    try {
        const Value attributes = primitive["attributes"];
        const AccessorSet set = accessors_of(attributes);
        const auto absent = std::ranges::count(set, Block::absent);
        const std::uint64_t vertices = elements(attributes[stream_name[position]]);
        const std::uint64_t indices = primitive.has("indices") ? elements(primitive["indices"]) : vertices;
        return (set.size() - static_cast<std::size_t>(absent)) * vertices + indices;
    } catch (const Error&) {
        return 0;
    }
}

std::uint64_t work_of(const Document& document, std::span<const PlacedNode> nodes) try {
    std::uint64_t work = 0;
    std::map<std::size_t, std::uint64_t> of_mesh;  // nodes may share one
    for (const PlacedNode& placed : nodes) {
        const Value node = document.root()["nodes"][placed.node];
        if (!node.has("mesh")) continue;
        const auto [known, is_new] = of_mesh.try_emplace(node["mesh"].whole(), 0);
        const Value primitives = document.entry("meshes", node["mesh"])["primitives"];
        for (std::size_t i = 0; is_new && i < primitives.size(); ++i)
            known->second += work_of(document, primitives[i]);
        work += known->second;
    }
    return work;
} catch (const Error&) {
    return 0;
}

}  // namespace goffer::mesh::gltf
