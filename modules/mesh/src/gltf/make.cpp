// SPDX-License-Identifier: MIT
#include "color.hpp"
#include "face_cutter.hpp"
#include "format.hpp"
#include "gltf.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace goffer::mesh::gltf {

namespace {

constexpr int attribute_target = 34962, index_target = 34963;

/// Which value of each stream a glTF vertex has: position, normal, tangent, UV sets; or `none`.
using Key = std::vector<std::uint32_t>;

/// The mesh's vertices with one index for all streams, as glTF has them. They are in the order of the mesh's
/// vertices; a vertex that occurs with several values is there once for each, in the order of use. A vertex
/// that no face uses is kept.
struct Split {
    std::vector<Key> keys;
    std::vector<std::uint32_t> corners;  ///< of the faces, into keys
};

Key key_at(const Mesh& mesh, std::size_t corner) {
    const std::uint32_t vertex = mesh.corners[corner];
    Key key{vertex, value_at(mesh.normals, corner, vertex), value_at(mesh.tangents, corner, vertex)};
    for (const auto& set : mesh.uvs) key.push_back(value_at(set, corner, vertex));
    return key;
}

Key unused_key(const Mesh& mesh, std::uint32_t vertex) {
    const auto index = [&](const auto& attribute) {
        return attribute.per_vertex() && !attribute.empty() ? vertex : none;
    };
    Key key{vertex, index(mesh.normals), index(mesh.tangents)};
    for (const auto& set : mesh.uvs) key.push_back(index(set));
    return key;
}

/// The corners of the faces by their vertices: those of vertex v, in their order, are from first[v] to
/// first[v + 1].
struct CornersOfVertices {
    std::vector<std::size_t> corners, first;
};

CornersOfVertices corners_of_vertices(const Mesh& mesh) {
    CornersOfVertices of;
    of.first.assign(mesh.positions.size() + 1, 0);
    for (const std::uint32_t vertex : mesh.corners) ++of.first[vertex + 1];
    std::partial_sum(of.first.begin(), of.first.end(), of.first.begin());
    std::vector<std::size_t> next(of.first.begin(), std::prev(of.first.end()));
    of.corners.resize(mesh.corners.size());
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
        of.corners[next[mesh.corners[corner]]++] = corner;
    return of;
}

Split split(const Mesh& mesh) {
    const CornersOfVertices of = corners_of_vertices(mesh);
    Split result;
    result.corners.resize(mesh.corners.size());
    std::map<Key, std::uint32_t> known;
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        known.clear();
        for (std::size_t i = of.first[vertex]; i < of.first[vertex + 1]; ++i) {
            const auto next = static_cast<std::uint32_t>(result.keys.size());
            const auto [entry, is_new] = known.try_emplace(key_at(mesh, of.corners[i]), next);
            if (is_new) result.keys.push_back(entry->first);
            result.corners[of.corners[i]] = entry->second;
        }
        if (known.empty()) result.keys.push_back(unused_key(mesh, vertex));
    }
    return result;
}

float finite(float value) {
    return std::isfinite(value) ? value : 0.0f;
}

/// The vector at unit length; null if it has no direction.
std::optional<glm::vec3> unit_or_null(const glm::dvec3& v) {
    const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(most > 0.0 && std::isfinite(most))) return std::nullopt;
    return glm::vec3(glm::normalize(v / most));
}

class Maker {
public:
    explicit Maker(const Mesh& mesh) : mesh_(mesh), split_(split(mesh)) {}

    Output run() &&;

private:
    std::size_t add_accessor(const std::string& bytes, int type, const char* shape, std::size_t count,
                             int target);
    template <int N>
    std::size_t add_stream(const std::vector<glm::vec<N, float>>& values);
    [[nodiscard]] std::vector<glm::vec3> face_normals() const;
    [[nodiscard]] std::vector<glm::vec3> normals() const;
    [[nodiscard]] std::vector<glm::vec4> tangents(const std::vector<glm::vec3>& normals) const;
    Json attributes();
    std::size_t add_indices(const Part& part, std::size_t& corner);
    void add_materials();
    Json primitives(const Json& attributes, bool named);

    const Mesh& mesh_;
    Split split_;
    Json json_;
    // These are not in json_ yet, because a new key there moves all others.
    Json views_ = Json::array(), accessors_ = Json::array();
    std::string buffer_;
};

std::size_t Maker::add_accessor(const std::string& bytes, int type, const char* shape, std::size_t count,
                                int target) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}, {"target", target}});
    accessors_.push_back(
        {{"bufferView", views_.size() - 1}, {"componentType", type}, {"count", count}, {"type", shape}});
    buffer_ += bytes;
    return accessors_.size() - 1;
}

template <int N>
std::size_t Maker::add_stream(const std::vector<glm::vec<N, float>>& values) {
    constexpr const char* shapes[] = {"VEC2", "VEC3", "VEC4"};
    return add_accessor(bytes_of(values), float_type, shapes[N - 2], values.size(), attribute_target);
}

/// The normal of each glTF vertex from its faces, for vertices whose own normal has no direction.
std::vector<glm::vec3> Maker::face_normals() const {
    std::vector<glm::dvec3> sums(split_.keys.size(), glm::dvec3(0.0));
    std::size_t corner = 0;
    for (const std::uint32_t face : mesh_.faces) {
        const auto point = [&](std::size_t k) {
            return glm::dvec3(mesh_.positions[mesh_.corners[corner + k]]);
        };
        glm::dvec3 normal_sum(0.0);
        for (std::uint32_t k = 1; k + 1 < face; ++k)
            normal_sum += glm::cross(point(k) - point(0), point(k + 1) - point(0));
        for (std::uint32_t k = 0; k < face; ++k) sums[split_.corners[corner + k]] += normal_sum;
        corner += face;
    }
    std::vector<glm::vec3> normals;
    normals.reserve(sums.size());
    for (const glm::dvec3& sum : sums)
        normals.push_back(unit_or_null(sum).value_or(glm::vec3(0.0f, 0.0f, 1.0f)));
    return normals;
}

std::vector<glm::vec3> Maker::normals() const {
    std::vector<glm::vec3> result = face_normals();
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::uint32_t index = split_.keys[i][1];
        if (index != none)
            result[i] = unit_or_null(glm::dvec3(mesh_.normals.values[index])).value_or(result[i]);
    }
    return result;
}

/// A tangent without a direction becomes some direction orthogonal to the normal.
std::vector<glm::vec4> Maker::tangents(const std::vector<glm::vec3>& normals) const {
    std::vector<glm::vec4> result;
    for (std::size_t i = 0; i < split_.keys.size(); ++i) {
        const glm::vec3 n = normals.empty() ? glm::vec3(0.0f, 0.0f, 1.0f) : normals[i];
        const glm::dvec3 across =
            glm::cross(glm::dvec3(n), std::abs(n.x) < 0.5f ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
        const std::uint32_t index = split_.keys[i][2];
        const glm::vec4 own = index == none ? glm::vec4(0.0f) : mesh_.tangents.values[index];
        const auto direction = unit_or_null(glm::dvec3(own));
        result.emplace_back(direction.value_or(*unit_or_null(across)), own.w < 0.0f ? -1.0f : 1.0f);
    }
    return result;
}

Json Maker::attributes() {
    Json result = Json::object();
    std::vector<glm::vec3> positions, made_normals;
    for (const Key& key : split_.keys) positions.push_back(mesh_.positions[key[0]]);
    result["POSITION"] = add_stream(positions);
    const float* floats = &positions[0].x;
    set_bounds(accessors_.back(), std::vector<float>(floats, floats + 3 * positions.size()), 3);
    if (!mesh_.normals.empty()) {
        made_normals = normals();
        result["NORMAL"] = add_stream(made_normals);
    }
    if (!mesh_.tangents.empty()) result["TANGENT"] = add_stream(tangents(made_normals));
    for (std::size_t set = 0; set < mesh_.uvs.size(); ++set) {
        std::vector<glm::vec2> uvs;
        for (const Key& key : split_.keys) {
            const glm::vec2 uv = key[3 + set] == none ? glm::vec2(0.0f) : mesh_.uvs[set].values[key[3 + set]];
            uvs.emplace_back(finite(uv.x), finite(1 - uv.y));  // glTF's v points down
        }
        result["TEXCOORD_" + std::to_string(set)] = add_stream(uvs);
    }
    if (!mesh_.colors.empty()) {
        std::vector<glm::vec4> colors;
        for (const Key& key : split_.keys) {
            const glm::vec4& c = mesh_.colors[key[0]];
            const glm::vec4 cleaned(finite(c.r), finite(c.g), finite(c.b), finite(c.a));
            colors.push_back(glm::clamp(color_as(true, mesh_, cleaned), 0.0f, 1.0f));
        }
        result["COLOR_0"] = add_stream(colors);
    }
    return result;
}

/// Adds the indices of a part's triangles. `corner` moves behind the part.
std::size_t Maker::add_indices(const Part& part, std::size_t& corner) {
    std::vector<std::uint32_t> indices;
    FaceCutter cut(mesh_);
    for (std::uint32_t f = part.first_face; f < part.first_face + part.face_count; ++f) {
        for (const std::size_t own : cut(corner, mesh_.faces[f])) indices.push_back(split_.corners[own]);
        corner += mesh_.faces[f];
    }
    // glTF reserves the largest index.
    if (split_.keys.size() > std::numeric_limits<std::uint16_t>::max()) {
        return add_accessor(bytes_of(indices), u32_type, "SCALAR", indices.size(), index_target);
    }
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    return add_accessor(bytes_of(narrow), u16_type, "SCALAR", narrow.size(), index_target);
}

void Maker::add_materials() {
    for (const Material& material : mesh_.materials) {
        Json entry = Json::object();
        if (!material.name.empty()) entry["name"] = material.name;
        Json color = Json::array();
        for (int i = 0; i < 4; ++i) color.push_back(std::clamp(finite(material.base_color[i]), 0.0f, 1.0f));
        entry["pbrMetallicRoughness"] = {{"baseColorFactor", color}, {"metallicFactor", 0.0}};
        if (material.base_color.a < 1.0f) entry["alphaMode"] = "BLEND";
        json_["materials"].push_back(std::move(entry));
    }
}

/// One primitive for each part, all with the same vertices. glTF has no names for primitives: where parts
/// differ in name, the primitives carry them as extras.
Json Maker::primitives(const Json& attributes, bool named) {
    const Part whole{"", -1, 0, static_cast<std::uint32_t>(mesh_.faces.size())};
    const std::vector<Part> parts = mesh_.parts.empty() ? std::vector<Part>{whole} : mesh_.parts;
    Json result = Json::array();
    std::size_t corner = 0;
    for (const Part& part : parts) {
        if (part.face_count == 0) continue;
        Json primitive = Json::object();
        primitive["attributes"] = attributes;
        primitive["indices"] = add_indices(part, corner);
        if (part.material >= 0) primitive["material"] = part.material;
        if (named) primitive["extras"]["name"] = part.name;
        result.push_back(std::move(primitive));
    }
    return result;
}

Output Maker::run() && {
    const bool one_name = std::adjacent_find(mesh_.parts.begin(), mesh_.parts.end(),
                                             [](const Part& a, const Part& b) { return a.name != b.name; }) ==
                          mesh_.parts.end();
    Json entry = Json::object(), node = Json::object();
    if (one_name && !mesh_.parts.empty() && !mesh_.parts[0].name.empty())
        node["name"] = entry["name"] = mesh_.parts[0].name;
    node["mesh"] = 0;
    const Json shared = attributes();
    entry["primitives"] = primitives(shared, !one_name);
    json_["asset"] = {{"version", "2.0"}, {"generator", "goffer"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    json_["nodes"].push_back(std::move(node));
    json_["meshes"].push_back(std::move(entry));
    add_materials();
    json_["accessors"] = std::move(accessors_);
    json_["bufferViews"] = std::move(views_);
    return {std::move(json_), std::move(buffer_)};
}

}  // namespace

Output made(const Mesh& mesh) {
    return Maker(mesh).run();
}

}  // namespace goffer::mesh::gltf
