// SPDX-License-Identifier: MIT
#include "edit.hpp"
#include "morph.hpp"

#include <algorithm>
#include <limits>

namespace goffer::mesh::gltf {

namespace {

/// The elements, of three components each, that are not zero.
std::vector<std::uint32_t> moved(const std::vector<float>& values) {
    std::vector<std::uint32_t> elements;
    for (std::size_t i = 0; i < values.size(); i += 3) {
        if (values[i] != 0.0f || values[i + 1] != 0.0f || values[i + 2] != 0.0f)
            elements.push_back(static_cast<std::uint32_t>(i / 3));
    }
    return elements;
}

/// The smallest type for indices of so many elements.
int index_type(std::size_t elements) {
    if (elements <= std::size_t{std::numeric_limits<std::uint8_t>::max()} + 1) return u8_type;
    return elements <= std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1 ? u16_type : u32_type;
}

std::size_t size_of(int type) {
    return type == u8_type ? 1 : type == u16_type ? 2 : 4;
}

std::string index_bytes(const std::vector<std::uint32_t>& indices, int type) {
    if (type == u8_type) return bytes_of(std::vector<std::uint8_t>(indices.begin(), indices.end()));
    if (type == u16_type) return bytes_of(std::vector<std::uint16_t>(indices.begin(), indices.end()));
    return bytes_of(indices);
}

}  // namespace

std::size_t Growing::add_view(const std::string& bytes, bool of_vertices) {
    if (!json.contains("bufferViews")) json["bufferViews"] = Json::array();
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (of_vertices) view["target"] = Replacement::vertices;
    json["bufferViews"].push_back(std::move(view));
    buffer += bytes;
    return json["bufferViews"].size() - 1;
}

std::size_t Growing::add(const std::string& bytes, int component, const char* type, std::size_t count) {
    const std::size_t view = add_view(bytes, false);
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return json["accessors"].size() - 1;
}

std::size_t Growing::add_displacements(const std::vector<float>& values) {
    const std::size_t count = values.size() / 3;
    const std::vector<std::uint32_t> elements = moved(values);
    const int type = index_type(count);
    Json accessor = {{"componentType", float_type}, {"count", count}, {"type", "VEC3"}};
    if (elements.size() * (size_of(type) + 3 * sizeof(float)) >= values.size() * sizeof(float)) {
        accessor["bufferView"] = add_view(bytes_of(values), true);
    } else if (!elements.empty()) {
        std::vector<float> kept;
        kept.reserve(3 * elements.size());
        for (const std::size_t i : elements)
            for (std::size_t c = 0; c < 3; ++c) kept.push_back(values[3 * i + c]);
        Json& sparse = accessor["sparse"];
        sparse["count"] = elements.size();
        sparse["indices"] = {{"bufferView", add_view(index_bytes(elements, type), false)},
                             {"componentType", type}};
        sparse["values"] = {{"bufferView", add_view(bytes_of(kept), false)}};
    }
    set_bounds(accessor, values, 3);
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
}

}  // namespace goffer::mesh::gltf
