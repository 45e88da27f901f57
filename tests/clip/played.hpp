// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

/// A reader of animated glTF that shares no code with goffer: what a player shows at a key.

namespace goffer::test {

/// What a node with a mesh shows of one of its primitives, in the scene's space.
struct PlayedPrimitive {
    std::vector<glm::dvec3> positions, normals;
    std::vector<std::uint32_t> indices;
};

/// A GLB that is played.
class Player {
public:
    explicit Player(const std::string& glb) {
        const auto u32 = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, glb.data() + at, 4);
            return value;
        };
        json = nlohmann::json::parse(glb.substr(20, u32(12)));
        bin = glb.substr(28 + u32(12));
    }
    Player(nlohmann::json document, std::string buffer) : json(std::move(document)), bin(std::move(buffer)) {}

    nlohmann::json json;
    std::string bin;

    /// How many keys the longest sampler has; 0 without an animation.
    [[nodiscard]] std::size_t keys() const {
        std::size_t most = 0;
        for (const auto& sampler : samplers()) most = std::max(most, floats(sampler["input"]).size());
        return most;
    }

    /// All primitives of the scene at `time`, in the order of the walk through its nodes.
    [[nodiscard]] std::vector<PlayedPrimitive> at(double time) const {
        std::vector<PlayedPrimitive> out;
        for (const auto& root : json["scenes"][json.value("scene", 0)]["nodes"])
            walk(root, glm::dmat4(1.0), time, out);
        return out;
    }

    [[nodiscard]] std::vector<double> floats(std::size_t accessor) const {
        const auto& a = json["accessors"][accessor];
        const std::size_t width = width_of(a), count = a["count"];
        std::vector<double> values(width * count, 0.0);
        if (a.contains("bufferView"))
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = component(a, a, a["componentType"], i, width);
        if (a.contains("sparse")) {
            const auto& s = a["sparse"];
            for (std::size_t i = 0; i < s["count"]; ++i) {
                const auto to =
                    static_cast<std::size_t>(component(a, s["indices"], s["indices"]["componentType"], i, 1));
                for (std::size_t c = 0; c < width; ++c)
                    values[width * to + c] =
                        component(a, s["values"], a["componentType"], width * i + c, width);
            }
        }
        return values;
    }

private:
    [[nodiscard]] nlohmann::json samplers() const {
        return json.contains("animations") ? json["animations"][0]["samplers"] : nlohmann::json::array();
    }
    static std::size_t width_of(const nlohmann::json& accessor) {
        const std::string type = accessor["type"];
        return type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
    }
    template <class T>
    static double get(const char* at) {
        T value{};
        std::memcpy(&value, at, sizeof(T));
        return static_cast<double>(value);
    }
    [[nodiscard]] double component(const nlohmann::json& accessor, const nlohmann::json& where, int type,
                                   std::size_t i, std::size_t width) const {
        const auto& view = json["bufferViews"][where["bufferView"].get<std::size_t>()];
        const std::size_t size = type == 5126 || type == 5125 ? 4 : type == 5122 || type == 5123 ? 2 : 1;
        const std::size_t stride = view.value("byteStride", size * width);
        const std::size_t offset = view.value("byteOffset", std::size_t{0}) +
                                   where.value("byteOffset", std::size_t{0}) + i / width * stride +
                                   i % width * size;
        if (offset + size > bin.size()) throw std::out_of_range("an accessor reaches beyond the buffer");
        const char* at = bin.data() + offset;
        if (type == 5126) return get<float>(at);
        if (type == 5125) return get<std::uint32_t>(at);
        if (type == 5123)
            return get<std::uint16_t>(at) / (accessor.value("normalized", false) ? 65535.0 : 1.0);
        return get<std::uint8_t>(at) / (accessor.value("normalized", false) ? 255.0 : 1.0);
    }

    /// The value that a node's `path` has at `time`; `otherwise` where it is not animated.
    [[nodiscard]] std::vector<double> animated(std::size_t node, const std::string& path, double time,
                                               std::vector<double> otherwise) const {
        if (!json.contains("animations")) return otherwise;
        for (const auto& channel : json["animations"][0]["channels"]) {
            if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
            const auto sampler = samplers()[channel["sampler"].get<std::size_t>()];
            CHECK(sampler["interpolation"] == "LINEAR");
            const std::vector<double> times = floats(sampler["input"]), values = floats(sampler["output"]);
            const std::size_t width = values.size() / times.size();
            std::size_t next = 0;
            while (next + 1 < times.size() && times[next] < time - 1e-9) ++next;
            const std::size_t before = next == 0 || times[next] <= time ? next : next - 1;
            const double t = next == before ? 0.0 : (time - times[before]) / (times[next] - times[before]);
            std::vector<double> out(width);
            for (std::size_t c = 0; c < width; ++c)
                out[c] = (1 - t) * values[before * width + c] + t * values[next * width + c];
            return out;
        }
        return otherwise;
    }

    [[nodiscard]] glm::dmat4 local(std::size_t node, double time) const {
        const auto& n = json["nodes"][node];
        if (n.contains("matrix")) return glm::make_mat4(n["matrix"].get<std::vector<double>>().data());
        const auto value = [&](const char* path, std::vector<double> none) {
            if (n.contains(path)) none = n[path].get<std::vector<double>>();
            return animated(node, path, time, none);
        };
        const auto t = value("translation", {0, 0, 0}), r = value("rotation", {0, 0, 0, 1}),
                   s = value("scale", {1, 1, 1});
        return glm::translate(glm::dmat4(1.0), glm::dvec3(t[0], t[1], t[2])) *
               glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))) *
               glm::scale(glm::dmat4(1.0), glm::dvec3(s[0], s[1], s[2]));
    }

    [[nodiscard]] std::vector<glm::dvec3> blended(const nlohmann::json& primitive, const char* name,
                                                  const std::vector<double>& weights) const {
        std::vector<double> sum = floats(primitive["attributes"][name]);
        for (std::size_t k = 0; primitive.contains("targets") && k < primitive["targets"].size(); ++k) {
            if (!primitive["targets"][k].contains(name)) continue;
            const std::vector<double> shape = floats(primitive["targets"][k][name]);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights.at(k) * shape[i];
        }
        std::vector<glm::dvec3> out;
        for (std::size_t i = 0; i < sum.size(); i += 3) out.emplace_back(sum[i], sum[i + 1], sum[i + 2]);
        return out;
    }

    void walk(std::size_t node, const glm::dmat4& parent, double time,
              std::vector<PlayedPrimitive>& out) const {
        const glm::dmat4 world = parent * local(node, time);
        const auto& n = json["nodes"][node];
        if (n.contains("mesh")) {
            const auto& mesh = json["meshes"][n["mesh"].get<std::size_t>()];
            const auto weights =
                animated(node, "weights", time, mesh.value("weights", std::vector<double>{}));
            for (const auto& primitive : mesh["primitives"]) {
                PlayedPrimitive played;
                played.positions = blended(primitive, "POSITION", weights);
                for (auto& p : played.positions) p = glm::dvec3(world * glm::dvec4(p, 1.0));
                if (primitive["attributes"].contains("NORMAL")) {
                    played.normals = blended(primitive, "NORMAL", weights);
                    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(world)));
                    for (auto& v : played.normals) v = glm::normalize(turn * v);
                }
                if (primitive.contains("indices"))
                    for (const double i : floats(primitive["indices"]))
                        played.indices.push_back(static_cast<std::uint32_t>(i));
                if (glm::determinant(glm::dmat3(world)) < 0)  // a mirror turns the winding
                    for (std::size_t i = 0; i + 2 < played.indices.size(); i += 3)
                        std::swap(played.indices[i + 1], played.indices[i + 2]);
                out.push_back(std::move(played));
            }
        }
        for (const auto& child : n.value("children", nlohmann::json::array())) walk(child, world, time, out);
    }
};

}  // namespace goffer::test
