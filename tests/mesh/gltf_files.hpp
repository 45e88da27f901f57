// SPDX-License-Identifier: MIT
#pragma once

#include "files.hpp"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

/// Small glTF documents made by hand, and access to those that goffer writes.

namespace goffer::test {

using Json = nlohmann::ordered_json;

inline std::string base64(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    unsigned bits = 0;
    int held = 0;
    for (const char byte : bytes) {
        bits = (bits << 8) | static_cast<unsigned char>(byte);
        for (held += 8; held >= 6; held -= 6) text += digits[(bits >> (held - 6)) & 63];
    }
    if (held > 0) text += digits[(bits << (6 - held)) & 63];
    while (text.size() % 4 != 0) text += '=';
    return text;
}

template <class T>
std::string raw(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A document and the bytes of its one buffer.
struct Document {
    Json json = Json::parse(R"({"asset": {"version": "2.0"}})");
    std::string buffer;

    std::size_t view(const std::string& bytes, int stride = 0) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        Json entry = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
        if (stride != 0) entry["byteStride"] = stride;
        json["bufferViews"].push_back(entry);
        buffer += bytes;
        return json["bufferViews"].size() - 1;
    }
    std::size_t accessor(std::size_t in_view, int component, const char* type, std::size_t count,
                         std::size_t offset = 0) {
        Json entry = {
            {"bufferView", in_view}, {"componentType", component}, {"count", count}, {"type", type}};
        if (offset != 0) entry["byteOffset"] = offset;
        json["accessors"].push_back(entry);
        return json["accessors"].size() - 1;
    }
    std::size_t floats(const std::vector<float>& values, const char* type) {
        const std::size_t width = std::string(type) == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
        const std::size_t index = accessor(view(raw(values)), 5126, type, values.size() / width);
        std::vector<double> least(width, 1e30), most(width, -1e30);
        for (std::size_t i = 0; i < values.size(); ++i) {
            least[i % width] = std::min(least[i % width], static_cast<double>(values[i]));
            most[i % width] = std::max(most[i % width], static_cast<double>(values[i]));
        }
        json["accessors"].back()["min"] = least;
        json["accessors"].back()["max"] = most;
        return index;
    }
    std::size_t shorts(const std::vector<std::uint16_t>& values) {
        return accessor(view(raw(values)), 5123, "SCALAR", values.size());
    }
    [[nodiscard]] std::string gltf() const {
        Json whole = json;
        Json entry = {{"byteLength", buffer.size()},
                      {"uri", "data:application/octet-stream;base64," + base64(buffer)}};
        if (!whole.contains("buffers")) whole["buffers"].push_back(entry);
        return whole.dump();
    }
    [[nodiscard]] std::string glb() const {
        Json whole = json;
        if (!whole.contains("buffers")) whole["buffers"].push_back({{"byteLength", buffer.size()}});
        std::string text = whole.dump(), binary = buffer;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary.resize((binary.size() + 3) / 4 * 4);
        const auto u32 = [](std::size_t value) {
            return raw(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
        };
        return "glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text +
               u32(binary.size()) + std::string("BIN\0", 4) + binary;
    }
};

/// The parts of a GLB: its JSON, and its buffer as long as the JSON says.
inline Document opened(const std::string& glb) {
    const auto u32 = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, glb.data() + at, 4);
        return value;
    };
    Document document;
    document.json = Json::parse(glb.substr(20, u32(12)));
    document.buffer = glb.substr(28 + u32(12), document.json["buffers"][0]["byteLength"]);
    return document;
}

inline const std::vector<float> tetra_points{0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3};

/// A tetrahedron in one node: all streams but colors; its corners look outward.
inline Document tetra() {
    Document document;
    const float h = std::sqrt(0.5f);
    const std::size_t points = document.floats(tetra_points, "VEC3"),
                      normals = document.floats({-h, -h, 0, h, h, 0, 0, 1, 0, 0, 0, 1}, "VEC3"),
                      tangents = document.floats({h, -h, 0, 1, h, -h, 0, 1, 1, 0, 0, -1, 1, 0, 0, 1}, "VEC4"),
                      uvs = document.floats({0, 0, 0.25f, 0, 0, 0.5f, 0.75f, 1}, "VEC2"),
                      indices = document.shorts({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
    Json attributes = {{"POSITION", points}, {"NORMAL", normals}, {"TANGENT", tangents}, {"TEXCOORD_0", uvs}};
    Json primitive = {{"attributes", attributes}, {"indices", indices}};
    Json mesh = {{"name", "tetra"}};
    mesh["primitives"].push_back(primitive);
    document.json["meshes"].push_back(mesh);
    document.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
    document.json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    document.json["scene"] = 0;
    return document;
}

inline Document tetra_with_nodes(const char* nodes) {
    Document document = tetra();
    document.json["nodes"] = Json::parse(nodes);
    return document;
}

inline Json& primitive_of(Document& document) {
    return document.json["meshes"][0]["primitives"][0];
}

inline mesh::Mesh load_document(const Document& document) {
    return load_text("d.glb", document.glb());
}

inline bool close(const glm::vec3& a, const glm::vec3& b, float within = 1e-6f) {
    return glm::length(a - b) <= within * std::max(1.0f, glm::length(b));
}

/// Six times the volume, positive where the faces look outward.
inline float volume(const mesh::Mesh& mesh) {
    float sum = 0.0f;
    for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
        const glm::vec3 &a = mesh.positions[mesh.corners[i]], &b = mesh.positions[mesh.corners[i + 1]],
                        &c = mesh.positions[mesh.corners[i + 2]];
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum;
}

}  // namespace goffer::test
