// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include "attributes.hpp"
#include "edit.hpp"
#include "interpolate.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace goffer::mesh {

namespace gltf {

namespace {

/// The new vertices of a block.
struct BlockCut {
    std::size_t count = 0;              ///< vertices before
    std::vector<EdgeVertex> vertices;   ///< in the block's numbers
    std::vector<std::uint32_t> number;  ///< the number of each in the mesh of refined_alone()
};

/// How to interpolate two values of an attribute.
enum class Kind { linear, direction, tangent, nearest };

Kind kind_of(const std::string& name, const Value& accessor) {
    if (name == "NORMAL") return Kind::direction;
    if (name == "TANGENT") return Kind::tangent;
    for (const char* smooth : {"POSITION", "TEXCOORD_", "COLOR_"})
        if (name.starts_with(smooth)) return Kind::linear;
    const bool real = accessor["componentType"].whole() == float_type || accessor.flag("normalized");
    return real ? Kind::linear : Kind::nearest;
}

/// Between two numbers, or the one that is finite.
double between(double a, double b, double t) {
    if (!std::isfinite(a)) return b;
    return std::isfinite(b) ? a + t * (b - a) : a;
}

void put_between(const float* a, const float* b, double t, Kind kind, std::size_t width, float* out) {
    if (kind == Kind::direction || kind == Kind::tangent) {
        const glm::vec3 made = direction(glm::make_vec3(a), glm::make_vec3(b), t);
        std::copy_n(glm::value_ptr(made), 3, out);
        if (kind == Kind::tangent) out[3] = t < 0.5 ? a[3] : b[3];
        return;
    }
    for (std::size_t i = 0; i < width; ++i) {
        const double from = a[i], to = b[i];
        out[i] = static_cast<float>(kind == Kind::linear ? between(from, to, t) : t < 0.5 ? from : to);
    }
}

/// Joints of one vertex, each with its weight.
using Influences = std::vector<std::pair<float, double>>;

/// The `count` heaviest joints of both ends, scaled to the weight that all of them had. Weights that are not
/// finite count for nothing.
Influences mixed(const Influences& a, const Influences& b, double t, std::size_t count) {
    std::map<float, double> sums;
    double whole = 0, kept = 0;
    const auto take = [&](const Influences& end, double share) {
        for (const auto& [joint, weight] : end)
            if (weight != 0 && std::isfinite(weight)) sums[joint] += share * weight;
    };
    take(a, 1 - t);
    take(b, t);
    Influences all(sums.begin(), sums.end());
    for (const auto& [joint, weight] : all) whole += weight;
    std::ranges::stable_sort(all, [](const auto& x, const auto& y) { return x.second > y.second; });
    all.resize(std::min(all.size(), count));
    for (const auto& [joint, weight] : all) kept += weight;
    constexpr double most = std::numeric_limits<float>::max();
    for (auto& [joint, weight] : all) weight = std::min(kept > 0 ? weight * whole / kept : weight, most);
    all.resize(count, {0.0f, 0.0});  // glTF wants unused ones to be joint 0
    return all;
}

std::string joints_name(std::size_t set) {
    return "JOINTS_" + std::to_string(set);
}

std::string weights_name(std::size_t set) {
    return "WEIGHTS_" + std::to_string(set);
}

/// Whether an attribute is one of the first `sets` sets of joints and weights.
bool is_of_set(const std::string& name, std::size_t sets) {
    for (std::size_t set = 0; set < sets; ++set)
        if (name == joints_name(set) || name == weights_name(set)) return true;
    return false;
}

class SceneRefiner {
public:
    SceneRefiner(const Document& document, const Cut& cut)
        : document_(document), cut_(cut), scene_(read_scene(document)), edit_(document) {}

    /// Returns the refined document. `order` becomes the number that each of its vertices has in the mesh of
    /// refined_alone().
    Output run(std::vector<std::uint32_t>& order, Share share) &&;

private:
    void share_out();
    void refine_block(std::size_t block, std::size_t first_part, Json& primitives);
    void refine_attributes(const BlockCut& cut, const Value& was, Json& primitive);
    void refine_targets(const BlockCut& cut, const Value& was, Json& primitive);
    void refine_skin(const BlockCut& cut, const Value& attributes, Json& primitive);
    void put_skin(const std::vector<Influences>& all, std::size_t set, const Value& attributes,
                  Json& primitive);
    void refine_indices(std::size_t block, const Part& part, const Value& was, Json& primitive);
    std::size_t refined(const BlockCut& cut, const Value& reference, Kind kind, bool bounds);
    [[nodiscard]] std::size_t width_of(const Value& reference) const;
    [[nodiscard]] std::vector<float> values_of(const BlockCut& cut, const Value& reference,
                                               std::size_t width) const;

    const Document& document_;
    const Cut& cut_;
    Scene scene_;
    Edit edit_;
    std::vector<BlockCut> blocks_;
    std::vector<std::uint32_t> in_block_;  ///< of each new vertex of the mesh: its number in its block
};

/// Both ends of an edge are in one block, since its triangle is.
void SceneRefiner::share_out() {
    std::vector<std::size_t> ends;
    for (const Block& block : scene_.blocks) {
        ends.push_back(block.first[position] + block.count);
        blocks_.emplace_back().count = block.count;
    }
    const auto before = static_cast<std::uint32_t>(cut_.mesh().positions.size());
    std::vector<std::size_t> block_of;  // of each new vertex
    for (std::uint32_t i = 0; i < cut_.pieces().vertices.size(); ++i) {
        const EdgeVertex& v = cut_.pieces().vertices[i];
        const auto b = v.a < before
                           ? static_cast<std::size_t>(std::ranges::upper_bound(ends, v.a) - ends.begin())
                           : block_of[v.a - before];
        const auto first = static_cast<std::uint32_t>(scene_.blocks[b].first[position]);
        const auto number = [&](std::uint32_t end) {
            return end < before ? end - first : in_block_[end - before];
        };
        const EdgeVertex own{number(v.a), number(v.b), v.t};
        in_block_.push_back(static_cast<std::uint32_t>(blocks_[b].count + blocks_[b].vertices.size()));
        blocks_[b].vertices.push_back(own);
        blocks_[b].number.push_back(before + i);
        block_of.push_back(b);
    }
}

std::size_t SceneRefiner::width_of(const Value& reference) const {
    const Value type = document_.entry("accessors", reference)["type"];
    if (type.text() == "SCALAR") return 1;
    for (std::size_t width : {2u, 3u, 4u})
        if (type.text() == "VEC" + std::to_string(width)) return width;
    type.fail("is a matrix, which cannot be interpolated; leave the attribute out, or do not refine");
}

/// The values of an accessor that has one for each vertex.
std::vector<float> SceneRefiner::values_of(const BlockCut& cut, const Value& reference,
                                           std::size_t width) const {
    std::vector<float> values = read_floats(document_, reference, width);
    if (values.size() != width * cut.count)
        reference.fail("has " + std::to_string(values.size() / width) + " elements, but POSITION has " +
                       std::to_string(cut.count) + "; export the file again");
    return values;
}

/// Replaces an accessor by one with the values of the new vertices behind its own; returns its number.
std::size_t SceneRefiner::refined(const BlockCut& cut, const Value& reference, Kind kind, bool bounds) {
    const std::size_t width = width_of(reference);
    std::vector<float> values = values_of(cut, reference, width);
    values.resize(values.size() + width * cut.vertices.size());
    float* out = values.data() + width * cut.count;
    for (const auto& [a, b, t] : cut.vertices) {
        put_between(&values[width * a], &values[width * b], t, kind, width, out);
        out += width;
    }
    return edit_.replace(
        {static_cast<std::size_t>(reference.whole()), float_fields(values, width, bounds), bytes_of(values)});
}

void SceneRefiner::refine_attributes(const BlockCut& cut, const Value& was, Json& primitive) {
    const Value attributes = was["attributes"];
    for (const auto& [name, index] : attributes.json().items()) {
        if (is_of_skin(name)) continue;
        const Value reference = attributes[name.c_str()];
        const Kind kind = kind_of(name, document_.entry("accessors", reference));
        primitive["attributes"][name] = refined(cut, reference, kind, name == stream_name[position]);
    }
    refine_skin(cut, attributes, primitive);
}

/// Morph targets are displacements, which are interpolated linearly.
void SceneRefiner::refine_targets(const BlockCut& cut, const Value& was, Json& primitive) {
    for (std::size_t i = 0; was.has("targets") && i < was["targets"].size(); ++i) {
        const Value target = was["targets"][i];
        for (const auto& [name, index] : target.json().items())
            primitive["targets"][i][name] =
                refined(cut, target[name.c_str()], Kind::linear, name == stream_name[position]);
    }
}

/// A new vertex may depend on the joints of both ends: as many are kept as there is room for.
void SceneRefiner::refine_skin(const BlockCut& cut, const Value& attributes, Json& primitive) {
    std::vector<Influences> all(cut.count);
    std::size_t sets = 0;
    for (; attributes.has(joints_name(sets).c_str()); ++sets) {
        const Value joints = attributes[joints_name(sets).c_str()];
        if (!attributes.has(weights_name(sets).c_str()))
            joints.fail("has no " + weights_name(sets) + " beside it; export the file again");
        const std::vector<float> who = values_of(cut, joints, 4);
        const std::vector<float> much = values_of(cut, attributes[weights_name(sets).c_str()], 4);
        for (std::size_t i = 0; i < who.size(); ++i) {
            if (!(who[i] >= 0 && who[i] <= std::numeric_limits<std::uint16_t>::max()))
                joints.fail("has a joint whose number is not 0..65535, for vertex " + std::to_string(i / 4) +
                            "; export the file again");
            all[i / 4].emplace_back(who[i], much[i]);
        }
    }
    for (const auto& [name, index] : attributes.json().items()) {
        if (is_of_skin(name) && !is_of_set(name, sets))
            attributes[name.c_str()].fail(
                "is not one of JOINTS_0, WEIGHTS_0, JOINTS_1 and so on, in pairs; export the file again");
    }
    if (sets == 0) return;
    for (const auto& [a, b, t] : cut.vertices) all.push_back(mixed(all[a], all[b], t, 4 * sets));
    for (std::size_t set = 0; set < sets; ++set) put_skin(all, set, attributes, primitive);
}

void SceneRefiner::put_skin(const std::vector<Influences>& all, std::size_t set, const Value& attributes,
                            Json& primitive) {
    std::vector<std::uint16_t> who;
    std::vector<float> much;
    for (const Influences& one : all) {
        for (std::size_t i = 4 * set; i < 4 * set + 4; ++i) {
            who.push_back(static_cast<std::uint16_t>(one[i].first));
            much.push_back(static_cast<float>(one[i].second));
        }
    }
    const Value joints = attributes[joints_name(set).c_str()],
                weights = attributes[weights_name(set).c_str()];
    const bool bytes = document_.entry("accessors", joints)["componentType"].whole() == u8_type &&
                       std::ranges::all_of(who, [](auto joint) { return joint <= 255; });
    Json fields = {{"componentType", bytes ? u8_type : u16_type}, {"count", all.size()}};
    primitive["attributes"][joints_name(set)] =
        edit_.replace({static_cast<std::size_t>(joints.whole()), std::move(fields),
                       bytes ? bytes_of(std::vector<std::uint8_t>(who.begin(), who.end())) : bytes_of(who)});
    primitive["attributes"][weights_name(set)] = edit_.replace(
        {static_cast<std::size_t>(weights.whole()), float_fields(much, 4, false), bytes_of(much)});
}

void SceneRefiner::refine_indices(std::size_t block, const Part& part, const Value& was, Json& primitive) {
    const Block& in = scene_.blocks[block];
    std::vector<std::uint32_t> indices;
    const bool faces = was.whole_or("mode", 4) >= 4;
    if (!faces && was.has("indices")) return;
    for (std::uint32_t v = 0; !faces && v < in.count; ++v) indices.push_back(v);  // not the new ones
    const std::size_t end = cut_.first_piece(part.first_face + std::size_t{part.face_count});
    const auto before = static_cast<std::uint32_t>(cut_.mesh().positions.size());
    for (std::size_t p = cut_.first_piece(part.first_face); p < end; ++p) {
        for (const std::uint32_t v : cut_.pieces().triangles.subspan(3 * p, 3))
            indices.push_back(v < before ? v - static_cast<std::uint32_t>(in.first[position])
                                         : in_block_[v - before]);
        if (in.placement.mirrored()) std::swap(indices.back(), indices[indices.size() - 2]);
    }
    if (indices.empty()) return;  // a part without a whole triangle
    if (faces) primitive.erase("mode");
    const bool wide = in.count + blocks_[block].vertices.size() > std::numeric_limits<std::uint16_t>::max();
    const std::size_t origin = was.has("indices") ? was["indices"].whole() : Replacement::none;
    primitive["indices"] = edit_.replace(
        {origin,
         {{"componentType", wide ? u32_type : u16_type}, {"count", indices.size()}, {"type", "SCALAR"}},
         wide ? bytes_of(indices) : bytes_of(std::vector<std::uint16_t>(indices.begin(), indices.end())),
         Replacement::indices});
}

void SceneRefiner::refine_block(std::size_t block, std::size_t first_part, Json& primitives) {
    const Block& in = scene_.blocks[block];
    if (blocks_[block].vertices.empty()) return;
    for (const std::size_t i : in.primitives) {
        const Value was = document_.root()["meshes"][in.mesh]["primitives"][i];
        refine_attributes(blocks_[block], was, primitives[i]);
        refine_targets(blocks_[block], was, primitives[i]);
        refine_indices(block, scene_.mesh.parts[first_part + i], was, primitives[i]);
    }
}

Output SceneRefiner::run(std::vector<std::uint32_t>& order, Share share) && {
    share_out();
    share = share.part(0.2, 1, scene_.blocks.size());
    std::vector<Shape> shapes;
    std::size_t first_part = 0, next_part = 0;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) {
        share.at(b);
        const Block& block = scene_.blocks[b];
        if (shapes.empty() || shapes.back().node != block.node) {
            first_part = next_part;
            shapes.push_back({block.node, block.mesh, document_.json["meshes"][block.mesh]["primitives"]});
        }
        next_part += block.primitives.size();
        refine_block(b, first_part, shapes.back().primitives);
        for (std::size_t v = 0; v < block.count; ++v)
            order.push_back(static_cast<std::uint32_t>(block.first[position] + v));
        order.insert(order.end(), blocks_[b].number.begin(), blocks_[b].number.end());
    }
    std::erase_if(shapes, [&](const Shape& s) {
        return s.primitives == document_.json["meshes"][s.mesh]["primitives"];
    });
    edit_.place(std::move(shapes));
    edit_.settle_accessors();
    return std::move(edit_).finish();
}

}  // namespace

}  // namespace gltf

/// The positions are taken from `alone`. Going through a node's transform and back might round them, and not
/// alike on both sides of a seam between nodes.
std::optional<Mesh> refined_gltf(const Cut& cut, const Mesh& alone, const Share& share) {
    const auto* source = dynamic_cast<const gltf::Document*>(cut.mesh().source.get());
    if (!source) return std::nullopt;
    std::optional<gltf::Output> now = gltf::rewritten(cut.mesh(), source->files.folder() / "refined", false);
    if (!now) return std::nullopt;
    const auto document = gltf::document_of(std::move(*now), *source);
    std::vector<std::uint32_t> order;
    gltf::Output output = gltf::SceneRefiner(*document, cut).run(order, share.part(0.1, 0.6));
    const auto made = gltf::document_of(std::move(output), *source);
    Mesh out = gltf::read_scene(*made, share.part(0.6, 1)).mesh;
    for (std::size_t i = 0; i < order.size(); ++i) out.positions[i] = alone.positions[order[i]];
    (void)gltf::read_textures(made, out);  // what it says has been said
    out.warnings = cut.mesh().warnings;
    out.source = made;
    return out;
}

}  // namespace goffer::mesh
