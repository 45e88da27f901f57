// SPDX-License-Identifier: MIT
#include "face_cutter.hpp"
#include "format.hpp"
#include "text.hpp"

#include <goffer/mesh/mesh.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

namespace goffer::mesh {
namespace {

struct Key {
    std::uint32_t vertex = none, normal = none, tangent = none, uv = none;
    auto operator<=>(const Key&) const = default;
};

/// What each entry of the vertex arrays is made of, and the entry of each face corner.
struct Split {
    std::vector<Key> keys;
    std::vector<std::uint32_t> corners;
};

Key key_of(const Mesh& mesh, const Attribute<glm::vec2>& uvs, std::size_t corner) {
    const std::uint32_t vertex = mesh.corners[corner];
    return {vertex, value_at(mesh.normals, corner, vertex), value_at(mesh.tangents, corner, vertex),
            value_at(uvs, corner, vertex)};
}

/// The key of a vertex that no face uses: it has an attribute only where that is one per vertex.
Key key_of_loose(const Mesh& mesh, const Attribute<glm::vec2>& uvs, std::uint32_t vertex) {
    const auto index = [&](const auto& attribute) {
        return attribute.per_vertex() && !attribute.empty() ? vertex : none;
    };
    return {vertex, index(mesh.normals), index(mesh.tangents), index(uvs)};
}

/// Splits by normals, tangents and `uvs`, which are without values where they do not count.
Split split(const Mesh& mesh, const Attribute<glm::vec2>& uvs) {
    Split out;
    out.keys.resize(mesh.positions.size());
    out.corners.resize(mesh.corners.size());
    std::map<Key, std::uint32_t> further;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const Key key = key_of(mesh, uvs, c);
        Key& first = out.keys[key.vertex];
        if (first.vertex == none) first = key;
        if (first == key) {
            out.corners[c] = key.vertex;
            continue;
        }
        const auto [entry, is_new] = further.try_emplace(key, static_cast<std::uint32_t>(out.keys.size()));
        if (is_new) out.keys.push_back(key);
        out.corners[c] = entry->second;
    }
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        if (out.keys[v].vertex == none) out.keys[v] = key_of_loose(mesh, uvs, v);
    return out;
}

std::vector<std::uint32_t> cut_up(const Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * triangle_count(mesh));
    FaceCutter cut(mesh);
    std::size_t first = 0;
    for (const std::uint32_t size : mesh.faces) {
        for (const std::size_t corner : cut(first, size)) triangles.push_back(corners[corner]);
        first += size;
    }
    return triangles;
}

template <class T>
std::vector<T> gather(const Attribute<T>& attribute, const std::vector<Key>& keys,
                      std::uint32_t Key::*index) {
    std::vector<T> out;
    if (attribute.empty()) return out;
    out.reserve(keys.size());
    for (const Key& key : keys) out.push_back(key.*index == none ? T{0.0f} : attribute.values[key.*index]);
    return out;
}

template <glm::length_t n>
std::array<std::uint32_t, n> bits(const glm::vec<n, float>& value) {
    std::array<std::uint32_t, n> out;
    for (glm::length_t i = 0; i < n; ++i)
        out[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(value[i]);
    return out;
}

/// A set of texture coordinates in which corners with the same value have the same index, so that only what
/// differs splits a vertex.
Attribute<glm::vec2> merged(Attribute<glm::vec2> uvs) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> known;
    for (std::uint32_t& corner : uvs.corners)
        if (corner != none) corner = known.try_emplace(bits(uvs.values[corner]), corner).first->second;
    return uvs;
}

/// The set that splits the vertices; empty where there is none.
Attribute<glm::vec2> splitting_uvs(const Mesh& mesh, std::size_t set) {
    return set < mesh.uvs.size() ? merged(mesh.uvs[set]) : Attribute<glm::vec2>();
}

VertexArrays arrays(const Mesh& mesh, const Attribute<glm::vec2>& uvs) {
    const Split parts = split(mesh, uvs);
    VertexArrays out;
    out.triangles = cut_up(mesh, parts.corners);
    out.normals = gather(mesh.normals, parts.keys, &Key::normal);
    out.tangents = gather(mesh.tangents, parts.keys, &Key::tangent);
    out.uvs = gather(uvs, parts.keys, &Key::uv);
    for (const Key& key : parts.keys) {
        out.positions.push_back(mesh.positions[key.vertex]);
        out.vertex.push_back(key.vertex);
    }
    return out;
}

/// Puts each entry's new value into the attribute: in the old value's place if the entry is the first to use
/// it or agrees with the first, else in a copy behind the others; a value per vertex cannot have any.
template <glm::length_t n>
void scatter(Attribute<glm::vec<n, float>>& attribute, const Split& split, std::uint32_t Key::*index,
             const std::vector<glm::vec<n, float>>& bent) {
    if (attribute.empty()) return;
    auto& values = attribute.values;
    std::vector<bool> taken(values.size(), false);
    std::map<std::pair<std::uint32_t, std::array<std::uint32_t, n>>, std::uint32_t> copies;
    std::vector<std::uint32_t> placed(split.keys.size(), none);
    for (std::size_t r = 0; r < split.keys.size(); ++r) {
        const std::uint32_t old = split.keys[r].*index;
        if (old == none) continue;
        placed[r] = old;
        if (!taken[old]) {
            taken[old] = true;
            values[old] = bent[r];
        } else if (!attribute.per_vertex() && bits(values[old]) != bits(bent[r])) {
            const auto next = static_cast<std::uint32_t>(values.size());
            const auto [copy, is_new] = copies.try_emplace({old, bits(bent[r])}, next);
            if (is_new) values.push_back(bent[r]);
            placed[r] = copy->second;
        }
    }
    for (std::size_t c = 0; c < attribute.corners.size(); ++c)
        attribute.corners[c] = placed[split.corners[c]];
}

template <class T>
bool fits(const Attribute<T>& attribute, const Mesh& mesh) {
    if (attribute.per_vertex()) return attribute.empty() || attribute.values.size() == mesh.positions.size();
    return attribute.corners.size() == mesh.corners.size() &&
           std::ranges::all_of(attribute.corners,
                               [&](auto i) { return i == none || i < attribute.values.size(); });
}

template <class T>
bool same_shape(const Attribute<T>& mesh, const Attribute<T>& read) {
    const auto same_presence = [](auto a, auto b) { return (a == none) == (b == none); };
    const bool split = !read.per_vertex() && mesh.values.size() > read.values.size();
    return (split || mesh.values.size() == read.values.size()) &&
           std::ranges::equal(mesh.corners, read.corners, same_presence);
}

bool parts_fit(const Mesh& mesh) {
    std::size_t next = 0;
    for (const Part& part : mesh.parts) {
        const bool material =
            part.material >= -1 && part.material < static_cast<std::int64_t>(mesh.materials.size());
        if (part.first_face != next || !material) return false;
        next += part.face_count;
    }
    return mesh.parts.empty() || next == mesh.faces.size();
}

void check_finite(const std::vector<glm::vec3>& values, const char* what, const std::filesystem::path& file) {
    const auto finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    const auto bad = std::ranges::find_if_not(values, finite);
    if (bad != values.end())
        fail(file, std::string(what) + " " + std::to_string(bad - values.begin()) +
                       " (counted from 0) is not finite; correct it, or remove what uses it");
}

}  // namespace

VertexArrays vertex_arrays(const Mesh& mesh) {
    return arrays(mesh, {});
}

VertexArrays vertex_arrays_with_uvs(const Mesh& mesh, std::size_t set) {
    VertexArrays out = arrays(mesh, splitting_uvs(mesh, set));
    out.uv_set = set;
    return out;
}

std::size_t triangle_count(const Mesh& mesh) {
    return mesh.corners.size() - 2 * mesh.faces.size();
}

std::vector<std::uint32_t> triangles(const Mesh& mesh) {
    return cut_up(mesh, mesh.corners);
}

std::vector<TriangleRange> triangles_of_parts(const Mesh& mesh) {
    std::vector<TriangleRange> ranges;
    ranges.reserve(mesh.parts.size());
    std::uint32_t next = 0;
    for (const Part& part : mesh.parts) {
        TriangleRange range{next, 0};
        for (std::uint32_t face = 0; face < part.face_count; ++face)
            range.count += mesh.faces[part.first_face + face] - 2;
        next += range.count;
        ranges.push_back(range);
    }
    return ranges;
}

Mesh with_vertex_arrays(const Mesh& mesh, const VertexArrays& bent) {
    const Split parts =
        split(mesh, bent.uvs.empty() ? Attribute<glm::vec2>() : splitting_uvs(mesh, bent.uv_set));
    const auto enough = [&](const auto& stream) { return stream.size() >= parts.keys.size(); };
    if (!enough(bent.positions) || (!mesh.normals.empty() && !enough(bent.normals)) ||
        (!mesh.tangents.empty() && !enough(bent.tangents)))
        throw Error("with_vertex_arrays: the mesh has " + std::to_string(parts.keys.size()) +
                    " entries; give each a position, and a normal and a tangent if the mesh has them");
    Mesh out = mesh;
    std::copy_n(bent.positions.begin(), out.positions.size(), out.positions.begin());
    scatter(out.normals, parts, &Key::normal, bent.normals);
    scatter(out.tangents, parts, &Key::tangent, bent.tangents);
    return out;
}

void check(const Mesh& mesh, const std::filesystem::path& file) {
    if (mesh.positions.empty()) fail(file, "there are no vertices; give a mesh that has some");
    if (mesh.faces.empty()) fail(file, "there are no faces; points and lines cannot be bent, give it faces");
    if (std::ranges::any_of(mesh.faces, [](auto size) { return size < 3; }) ||
        std::accumulate(mesh.faces.begin(), mesh.faces.end(), std::size_t{0}) != mesh.corners.size())
        fail(file, "faces and corners do not fit together; give each face 3 corners or more");
    const auto lost = std::ranges::find_if(mesh.corners, [&](auto v) { return v >= mesh.positions.size(); });
    if (lost != mesh.corners.end())
        fail(file, "corner " + std::to_string(lost - mesh.corners.begin()) + ": vertex index " +
                       std::to_string(*lost) + " is out of range: there are " +
                       std::to_string(mesh.positions.size()) + " vertices, counted from 0");
    const std::string mend = " do not fit; give one to each vertex, or an index in range to each corner";
    if (!fits(mesh.normals, mesh)) fail(file, "the normals" + mend);
    if (!fits(mesh.tangents, mesh)) fail(file, "the tangents" + mend);
    for (const auto& uvs : mesh.uvs)
        if (!fits(uvs, mesh)) fail(file, "the texture coordinates" + mend);
    if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size())
        fail(file, "the colors do not fit the vertices; give one to each or none");
    if (!parts_fit(mesh))
        fail(file, "the parts do not fit; let them cover all faces in order, and name materials that exist");
    check_finite(mesh.positions, "vertex", file);
    check_finite(mesh.normals.values, "normal", file);
}

bool only_bent(const Mesh& mesh, const Mesh& read) {
    return mesh.positions.size() == read.positions.size() && same_shape(mesh.normals, read.normals) &&
           same_shape(mesh.tangents, read.tangents) && mesh.uvs == read.uvs && mesh.colors == read.colors &&
           mesh.linear_colors == read.linear_colors && mesh.corners == read.corners &&
           mesh.faces == read.faces && mesh.parts == read.parts && mesh.materials == read.materials;
}

}  // namespace goffer::mesh
