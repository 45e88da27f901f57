// SPDX-License-Identifier: MIT
#include "attributes.hpp"
#include "gltf.hpp"
#include "text.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

namespace goffer::mesh::gltf {
namespace {

/// A stream of the mesh while it is gathered: where each block's values start.
template <class T>
struct Gathered {
    std::vector<T> values;
    std::vector<std::size_t> first;
};

class SceneReader {
public:
    SceneReader(const Document& document, Budget& budget, const Share& share)
        : document_(document), budget_(budget), share_(share) {}

    Scene read() &&;

private:
    void read_node(const PlacedNode& placed);
    void read_primitive(const PlacedNode& placed, const Value& primitive,
                        std::map<AccessorSet, std::size_t>& known);
    [[nodiscard]] Block begin_block(const PlacedNode& placed);
    [[nodiscard]] const SkinPlace& skin_of(const Value& node);
    void warn_of_skins();
    std::size_t read_block(const PlacedNode& placed, const Value& attributes, std::size_t uv_sets);
    void read_positions(Block& block, const Value& attributes);
    template <class T, class Place>
    void gather(Gathered<T>& gathered, Stream which, Block& block, const Value& attributes,
                const Place& place);
    void read_streams(Block& block, const Value& attributes);
    void read_colors(const Block& block, const Value& attributes);
    void read_uvs(const Block& block, const Value& attributes, std::size_t uv_sets);
    void add_faces(const Value& primitive, const Block& block);
    void add_triangle(const Block& block, std::uint32_t a, std::uint32_t b, std::uint32_t c);
    [[nodiscard]] std::vector<std::uint32_t> indices_of(const Value& primitive, std::size_t vertices);
    [[nodiscard]] std::vector<float> floats(const Value& reference, std::size_t width);
    [[nodiscard]] std::vector<float> stream(const Value& attributes, const char* name, std::size_t width,
                                            std::size_t vertices);
    void spend(const Value& reference, std::size_t width);
    void take_entry(std::size_t mesh);
    void warn(const std::string& what) { mesh_.warnings.push_back(what); }
    template <class T>
    [[nodiscard]] Attribute<T> finish(Gathered<T>&& gathered) const;

    const Document& document_;
    Mesh mesh_;
    std::vector<Block> blocks_;
    std::vector<std::size_t> part_block_;  ///< of each part
    Gathered<glm::vec3> normals_;
    Gathered<glm::vec4> tangents_;
    std::vector<Gathered<glm::vec2>> uvs_;
    Budget& budget_;
    Share share_;                                        ///< in values and indices
    std::uint64_t done_ = 0;                             ///< of these, before the ones that are being read
    std::uint64_t unbacked_ = 0;                         ///< elements that have no bytes behind them
    std::map<std::size_t, std::uint64_t> entry_memory_;  ///< of entries of the document's meshes
    std::span<const PlacedNode> nodes_;                  ///< of the scene, and, where there are skins,
    std::map<std::size_t, glm::dmat4> worlds_;           ///< their matrices
    std::map<std::size_t, SkinPlace> skins_;             ///< those in use
    std::vector<std::pair<std::string, std::size_t>> skinned_;  ///< paths of nodes, and their skins
};

/// Nodes and primitives may repeat an accessor without end. To be called before it is read: its values are
/// there twice for a while, and lists that grow have up to twice of what they hold.
void SceneReader::spend(const Value& reference, std::size_t width) {
    const Value accessor = document_.entry("accessors", reference);
    const std::uint64_t count = accessor["count"].whole();
    std::uint64_t most = max_unbacked;  // reading refuses what says more than there can be
    if (accessor.has("bufferView")) {
        most = document_.view(document_.entry("bufferViews", accessor["bufferView"])).size();
    } else if (count <= most) {
        unbacked_ += count;
        if (unbacked_ > max_unbacked) {
            reference.fail("with it the scene has more than " + std::to_string(max_unbacked) +
                           " elements without a bufferView; give them one");
        }
    }
    const std::uint64_t bytes = std::min(count, most) * width * sizeof(float);
    budget_.check(0, 0, 3 * bytes);
    budget_.take(2 * bytes);
}

std::vector<float> SceneReader::floats(const Value& reference, std::size_t width) {
    spend(reference, width);
    return read_floats(document_, reference, width);
}

/// The values of an attribute other than POSITION, as many as that has.
std::vector<float> SceneReader::stream(const Value& attributes, const char* name, std::size_t width,
                                       std::size_t vertices) {
    std::vector<float> values = floats(attributes[name], width);
    if (values.size() != width * vertices) {
        attributes[name].fail("has " + std::to_string(values.size() / width) +
                              " elements, but POSITION has " + std::to_string(vertices) +
                              "; export the file again");
    }
    return values;
}

Block SceneReader::begin_block(const PlacedNode& placed) {
    const Value node = document_.root()["nodes"][placed.node];
    Block block;
    block.node = placed.node;
    block.mesh = node["mesh"].whole();
    block.placement = Placement(node.has("skin") ? skin_of(node).matrix : placed.world);
    return block;
}

/// Where its joints place a skinned mesh, whatever its node. It keeps the shape that it was bound in.
const SkinPlace& SceneReader::skin_of(const Value& node) {
    const auto [place, is_new] = skins_.try_emplace(document_.number("skins", node["skin"]));
    if (is_new) {
        const Value skin = document_.entry("skins", node["skin"]);
        if (skin.has("inverseBindMatrices")) spend(skin["inverseBindMatrices"], 16);
        if (worlds_.empty())
            for (const PlacedNode& placed : nodes_) worlds_.emplace(placed.node, placed.world);
        place->second = place_of_skin(document_, skin, worlds_);
    }
    return place->second;
}

/// Primitives have no name in glTF. This writer, and some others, give them one as extras.
std::string name_of(const Value& primitive, const Value& node, const Value& mesh) {
    if (primitive.has("extras")) {
        const Value value = primitive["extras"];
        const Json& extras = value.json();
        if (extras.is_object() && extras.contains("name") && extras["name"].is_string())
            return extras["name"];
    }
    const std::string name = node.text_or("name", "");
    return name.empty() ? mesh.text_or("name", "") : name;
}

/// What a value takes in memory, all in all.
std::uint64_t memory_of(const Json& json) {
    std::uint64_t bytes = sizeof(Json);
    if (json.is_string()) bytes += sizeof(std::string) + json.get_ref<const std::string&>().size();
    if (json.is_array()) bytes += sizeof(Json::array_t);
    if (json.is_object()) bytes += sizeof(Json::object_t);
    if (json.is_structured())
        for (const auto& [key, child] : json.items())
            bytes += memory_of(child) + (json.is_object() ? sizeof(std::string) + key.size() : 0);
    return bytes;
}

/// Takes what a node's entry of the meshes needs in an output: each may be bent in its own way, and is then
/// written with all that the entry holds, once as JSON and once as text.
void SceneReader::take_entry(std::size_t mesh) {
    const auto [known, is_new] = entry_memory_.try_emplace(mesh, 0);
    if (is_new) known->second = memory_of(document_.json["meshes"][mesh]);
    budget_.take(2 * known->second);
}

void SceneReader::read_node(const PlacedNode& placed) {
    const Value node = document_.root()["nodes"][placed.node];
    if (!node.has("mesh")) return;
    const Value mesh = document_.entry("meshes", node["mesh"]);
    take_entry(node["mesh"].whole());
    if (node.has("skin")) skinned_.emplace_back(node.path(), document_.number("skins", node["skin"]));
    const Placement placement = begin_block(placed).placement;
    if (placement.singular()) {
        warn(node.path() +
             " is scaled to nothing or flat: bent vertices cannot be written back to it, so it keeps its "
             "shape in glTF output");
    }
    if (node.has("extensions") && node["extensions"].has("EXT_mesh_gpu_instancing")) {
        warn(node.path() + " is drawn many times: it is bent once, at the node's own place");
    }
    std::map<AccessorSet, std::size_t> known;
    const Value primitives =
        Value(mesh["primitives"].json(), "meshes[" + std::to_string(node["mesh"].whole()) + "].primitives");
    bool morphed = false;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Value primitive = primitives[i];
        const std::size_t part = mesh_.parts.size();
        read_primitive(placed, primitive, known);
        blocks_[part_block_[part]].primitives.push_back(i);
        mesh_.parts[part].name = name_of(primitive, node, mesh);
        budget_.take(2 * mesh_.parts[part].name.size());
        morphed = morphed || primitive.has("targets");
    }
    if (morphed) warn(node.path() + " has morph targets: it is taken in its rest shape, without them");
}

void SceneReader::read_primitive(const PlacedNode& placed, const Value& primitive,
                                 std::map<AccessorSet, std::size_t>& known) {
    const std::uint64_t end = done_ + (share_.is_heard() ? work_of(document_, primitive) : 0);
    const Value attributes = primitive["attributes"];
    const AccessorSet set = accessors_of(attributes);
    const auto found = known.find(set);
    const std::size_t block =
        found != known.end() ? found->second : read_block(placed, attributes, uv_sets_of(set));
    known.emplace(set, block);
    Part part;
    if (primitive.has("material")) {
        part.material = static_cast<std::int32_t>(document_.number("materials", primitive["material"]));
    }
    part.first_face = static_cast<std::uint32_t>(mesh_.faces.size());
    add_faces(primitive, blocks_[block]);
    part.face_count = static_cast<std::uint32_t>(mesh_.faces.size()) - part.first_face;
    budget_.take(2 * (sizeof(Part) + sizeof(Block)));
    mesh_.parts.push_back(std::move(part));
    part_block_.push_back(block);
    done_ = end;
}

std::size_t SceneReader::read_block(const PlacedNode& placed, const Value& attributes, std::size_t uv_sets) {
    Block block = begin_block(placed);
    read_positions(block, attributes);
    read_streams(block, attributes);
    read_colors(block, attributes);
    read_uvs(block, attributes, uv_sets);
    blocks_.push_back(std::move(block));
    return blocks_.size() - 1;
}

void SceneReader::read_positions(Block& block, const Value& attributes) {
    const Value reference = attributes[stream_name[position]];
    const std::vector<float> values = floats(reference, 3);
    block.count = values.size() / 3;
    budget_.take_vertices(block.count, 0);
    block.first[position] = mesh_.positions.size();
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec3 point = block.placement.point(glm::make_vec3(&values[3 * i]));
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
            reference.fail("vertex " + std::to_string(i) +
                           " is not finite (nan or infinite); remove it or export again");
        }
        mesh_.positions.push_back(point);
        share_.at(done_ + i);
    }
    done_ += block.count;
}

/// Gathers a stream that a block may have; place(value) is what the node makes of a value of the file.
template <class T, class Place>
void SceneReader::gather(Gathered<T>& gathered, Stream which, Block& block, const Value& attributes,
                         const Place& place) {
    if (attributes.has(stream_name[which])) {
        const std::size_t width = stream_width[which];
        block.first[which] = gathered.values.size();
        const std::vector<float> values = stream(attributes, stream_name[which], width, block.count);
        for (std::size_t i = 0; i < block.count; ++i) {
            gathered.values.push_back(place(&values[width * i]));
            share_.at(done_ + i);
        }
        done_ += block.count;
    }
    gathered.first.push_back(block.first[which]);
}

void SceneReader::read_streams(Block& block, const Value& attributes) {
    const Placement& placement = block.placement;
    gather(normals_, normal, block, attributes,
           [&](const float* value) { return placement.normal(glm::make_vec3(value)); });
    gather(tangents_, tangent, block, attributes,
           [&](const float* value) { return placement.tangent(glm::make_vec4(value)); });
}

/// A vertex without a color is white, which in glTF changes nothing.
void SceneReader::read_colors(const Block& block, const Value& attributes) {
    if (!attributes.has("COLOR_0")) return;
    const Value accessor = document_.entry("accessors", attributes["COLOR_0"]);
    const std::size_t width = accessor["type"].text() == "VEC4" ? 4 : 3;
    const std::vector<float> values = stream(attributes, "COLOR_0", width, block.count);
    budget_.take((mesh_.positions.size() - mesh_.colors.size()) * 2 * sizeof(glm::vec4));
    mesh_.linear_colors = true;
    mesh_.colors.resize(mesh_.positions.size(), glm::vec4(1.0f));
    for (std::size_t i = 0; i < values.size(); ++i) {
        mesh_.colors[block.first[position] + i / width][static_cast<int>(i % width)] = values[i];
    }
    done_ += block.count;
}

void SceneReader::read_uvs(const Block& block, const Value& attributes, std::size_t uv_sets) {
    while (uvs_.size() < uv_sets)
        uvs_.push_back({{}, std::vector<std::size_t>(blocks_.size(), Block::absent)});
    for (std::size_t set = 0; set < uvs_.size(); ++set) {
        uvs_[set].first.push_back(set < uv_sets ? uvs_[set].values.size() : Block::absent);
        if (set >= uv_sets) continue;
        const std::vector<float> values = stream(attributes, uv_name(set).c_str(), 2, block.count);
        for (std::size_t i = 0; i < block.count; ++i) {
            uvs_[set].values.emplace_back(values[2 * i], 1 - values[2 * i + 1]);  // glTF's v points down
            share_.at(done_ + i);
        }
        done_ += block.count;
    }
}

std::vector<std::uint32_t> SceneReader::indices_of(const Value& primitive, std::size_t vertices) {
    if (!primitive.has("indices")) {
        budget_.check(0, 0, vertices * sizeof(std::uint32_t));
        std::vector<std::uint32_t> all(vertices);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    spend(primitive["indices"], 1);
    std::vector<std::uint32_t> indices = read_indices(document_, primitive["indices"]);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < vertices) continue;
        primitive["indices"].fail("entry " + std::to_string(i) + " is vertex " + std::to_string(indices[i]) +
                                  ", but there are " + std::to_string(vertices) + "; export the file again");
    }
    return indices;
}

void SceneReader::add_triangle(const Block& block, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto first = static_cast<std::uint32_t>(block.first[position]);
    if (block.placement.mirrored()) std::swap(b, c);
    for (const std::uint32_t corner : {a, b, c}) mesh_.corners.push_back(first + corner);
    mesh_.faces.push_back(3);
}

void SceneReader::add_faces(const Value& primitive, const Block& block) {
    enum : std::uint64_t { triangles = 4, strip = 5, fan = 6 };
    const std::uint64_t mode = primitive.whole_or("mode", triangles);
    if (mode > fan)
        primitive["mode"].fail("is " + std::to_string(mode) + ", expected 0 to 6; export the file again");
    const std::vector<std::uint32_t> i = indices_of(primitive, block.count);
    const std::uint64_t faces = mode < triangles ? 0 : mode == triangles ? i.size() / 3 : i.size();
    budget_.take_faces(faces, 3 * faces, 2 * sizeof(std::uint32_t));
    if (mode < triangles) return;  // points and lines bend, but have no faces
    if (mode == triangles) {
        for (std::size_t k = 0; k + 2 < i.size(); k += 3) {
            add_triangle(block, i[k], i[k + 1], i[k + 2]);
            share_.at(done_ + k);
        }
        if (i.size() % 3 != 0) warn(primitive.path() + " ends in an incomplete triangle, which is left out");
        return;
    }
    for (std::size_t k = 0; k + 2 < i.size(); ++k) {
        const std::uint32_t a = mode == fan ? i[0] : i[k];
        if (a == i[k + 1] || a == i[k + 2] || i[k + 1] == i[k + 2])
            continue;  // strips are stitched with empty triangles
        const bool odd = mode == strip && k % 2 == 1;
        add_triangle(block, a, i[k + (odd ? 2 : 1)], i[k + (odd ? 1 : 2)]);
    }
}

/// One value per vertex where all blocks have the attribute, else an index for each face corner.
template <class T>
Attribute<T> SceneReader::finish(Gathered<T>&& gathered) const {
    if (gathered.values.empty()) return {};  // no part has it
    Attribute<T> attribute{std::move(gathered.values), {}};
    if (attribute.values.size() == mesh_.positions.size()) return attribute;
    budget_.take(mesh_.corners.size() * sizeof(std::uint32_t));
    attribute.corners.reserve(mesh_.corners.size());
    for (std::size_t p = 0, corner = 0; p < mesh_.parts.size(); ++p) {
        const Block& block = blocks_[part_block_[p]];
        const std::size_t first = gathered.first[part_block_[p]];
        for (std::size_t k = 0; k < 3 * std::size_t{mesh_.parts[p].face_count}; ++k, ++corner) {
            const std::size_t in_block = mesh_.corners[corner] - block.first[position];
            attribute.corners.push_back(
                first == Block::absent ? Attribute<T>::none : static_cast<std::uint32_t>(first + in_block));
        }
    }
    if (attribute.corners.empty()) attribute.values.clear();
    return attribute;
}

void SceneReader::warn_of_skins() {
    for (const bool bound : {true, false}) {
        std::vector<std::string> paths;
        for (const auto& [path, skin] : skinned_)
            if (skins_.at(skin).as_bound == bound) paths.push_back(path);
        if (paths.empty()) continue;
        const std::string which = paths.size() == 1 ? paths[0] + " is skinned: it is taken "
                                                    : paths[0] + " and " + std::to_string(paths.size() - 1) +
                                                          " more are skinned: they are taken ";
        warn(which + "in the shape that the file has, without bones" +
             (bound ? "" : ", where the first one places it"));
    }
}

Scene SceneReader::read() && {
    mesh_.materials = materials_of(document_);
    const std::vector<PlacedNode> nodes = nodes_of_scene(document_);
    if (share_.is_heard()) share_ = share_.part(0, 1, work_of(document_, nodes));
    nodes_ = nodes;
    for (const PlacedNode& placed : nodes) read_node(placed);
    warn_of_skins();
    if (mesh_.positions.empty()) {
        throw Error("no node of the scene carries a mesh with vertices; put one into the default scene");
    }
    mesh_.normals = finish(std::move(normals_));
    mesh_.tangents = finish(std::move(tangents_));
    for (auto& set : uvs_) mesh_.uvs.push_back(finish(std::move(set)));
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), glm::vec4(1.0f));
    return {std::move(mesh_), std::move(blocks_)};
}

}  // namespace

Scene read_scene(const Document& document, Budget& budget, const Share& share) {
    return SceneReader(document, budget, share).read();
}

Scene read_scene(const Document& document, const Share& share) {
    Budget no_limit;
    return read_scene(document, no_limit, share);
}

}  // namespace goffer::mesh::gltf
