// SPDX-License-Identifier: MIT
#include "morph.hpp"

#include "format.hpp"
#include "references.hpp"
#include "text.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/ending.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace goffer::mesh {

namespace gltf {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// The document that save() would write, and its scene. An output that was made anew names no other files.
std::shared_ptr<const Document> base_document(const Mesh& mesh, const std::filesystem::path& file, bool embed,
                                              bool& is_made) {
    std::optional<Output> kept = rewritten(mesh, file, embed);
    is_made = !kept;
    if (kept) return document_of(std::move(*kept), dynamic_cast<const Document&>(*mesh.source));
    return document_of(made(mesh), Document(io::NamedFiles(file, false)));
}

/// For each vertex of a scene that was made of `mesh`, its entry of vertex_arrays(mesh): both have the same
/// triangles in the same order, and vertices without faces in theirs.
std::vector<std::uint32_t> entries_of(const Mesh& made, const Mesh& mesh) {
    const VertexArrays arrays = vertex_arrays(mesh);
    std::vector<std::uint32_t> entries(made.positions.size(), none);
    for (std::size_t corner = 0; corner < arrays.triangles.size(); ++corner)
        entries[made.corners[corner]] = arrays.triangles[corner];
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t vertex : mesh.corners) used[vertex] = true;
    std::uint32_t loose = 0;
    for (std::uint32_t& entry : entries) {
        if (entry != none) continue;
        while (used[loose]) ++loose;
        entry = loose++;
    }
    return entries;
}

/// Gives the meshes of a document their targets.
class Morpher {
public:
    Morpher(const Mesh& mesh, const Morphing& morphing, const std::filesystem::path& file, bool embed);

    [[nodiscard]] Output run(std::vector<std::string>& warnings) &&;

private:
    [[nodiscard]] bool moves(const Block& block) const;
    [[nodiscard]] std::vector<float> shifts(const Block& block, const MorphTarget& target) const;
    [[nodiscard]] std::vector<float> turns(const Block& block, const MorphTarget& target,
                                           const std::vector<float>& normals) const;
    [[nodiscard]] Json targets_of(const Block& block, const Json& attributes);
    void morph(std::size_t first, std::size_t last, MeshUsers& users, std::vector<std::string>& warnings);

    [[nodiscard]] std::uint32_t entry(const Block& block, std::size_t i) const {
        const std::size_t vertex = block.first[position] + i;
        return entries_.empty() ? static_cast<std::uint32_t>(vertex) : entries_[vertex];
    }

    const Morphing& morphing_;
    std::shared_ptr<const Document> base_;
    Scene scene_;
    std::vector<std::uint32_t> entries_;  ///< of the scene's vertices; empty: they are the same
    Json json_;
    std::string buffer_;
    Growing document_{json_, buffer_};
};

Morpher::Morpher(const Mesh& mesh, const Morphing& morphing, const std::filesystem::path& file, bool embed)
    : morphing_(morphing) {
    bool is_made = false;
    base_ = base_document(mesh, file, embed, is_made);
    scene_ = read_scene(*base_);
    if (is_made) entries_ = entries_of(scene_.mesh, mesh);
    json_ = base_->json;
    if (!base_->buffers.empty()) buffer_ = base_->buffers[0];
}

bool Morpher::moves(const Block& block) const {
    if (block.placement.singular()) return false;
    for (const MorphTarget& target : morphing_.targets) {
        for (std::size_t i = 0; i < block.count; ++i) {
            const std::uint32_t e = entry(block, i);
            if (target.positions[e] != glm::vec3(0.0f)) return true;
            if (!target.normals.empty() && target.normals[e] != glm::vec3(0.0f)) return true;
        }
    }
    return false;
}

std::vector<float> Morpher::shifts(const Block& block, const MorphTarget& target) const {
    std::vector<float> values;
    values.reserve(3 * block.count);
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec3 local = block.placement.shift_back(target.positions[entry(block, i)]);
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(local[c]))
                throw Error("vertex " + std::to_string(block.first[position] + i) +
                            " moves too far for its node's scale; move it less, or scale the file");
            values.push_back(local[c]);
        }
    }
    return values;
}

/// The node's normals, which have some length, are those of the scene, times the transposed matrix, times a
/// factor. The targets' get the same.
std::vector<float> Morpher::turns(const Block& block, const MorphTarget& target,
                                  const std::vector<float>& normals) const {
    std::vector<float> values;
    values.reserve(3 * block.count);
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec3 stored = glm::make_vec3(&normals[3 * i]);
        const glm::vec3 turn = block.placement.turn_back(target.normals[entry(block, i)], stored);
        for (int c = 0; c < 3; ++c) values.push_back(std::isfinite(turn[c]) ? turn[c] : 0.0f);
    }
    return values;
}

Json Morpher::targets_of(const Block& block, const Json& attributes) {
    const bool has_normals = attributes.contains(stream_name[normal]) && block.first[normal] != Block::absent;
    std::vector<float> normals;
    if (has_normals) normals = read_floats(*base_, Value(attributes[stream_name[normal]], "NORMAL"), 3);
    Json all = Json::array();
    for (const MorphTarget& target : morphing_.targets) {
        Json entry = Json::object();
        entry[stream_name[position]] = document_.add_displacements(shifts(block, target));
        if (has_normals && !target.normals.empty())
            entry[stream_name[normal]] = document_.add_displacements(turns(block, target, normals));
        all.push_back(std::move(entry));
    }
    return all;
}

/// Gives the blocks from `first` to `last`, which are all of one node, their targets.
void Morpher::morph(std::size_t first, std::size_t last, MeshUsers& users,
                    std::vector<std::string>& warnings) {
    const std::size_t own = users.claim(scene_.blocks[first].node);
    bool had_targets = false;
    for (std::size_t b = first; b < last; ++b) {
        const Block& block = scene_.blocks[b];
        const Json attributes =
            document_.json["meshes"][own]["primitives"][block.primitives[0]]["attributes"];
        const Json targets = targets_of(block, attributes);
        for (const std::size_t i : block.primitives) {
            Json& primitive = document_.json["meshes"][own]["primitives"][i];
            had_targets = had_targets || primitive.contains("targets");
            primitive["targets"] = targets;
        }
    }
    Json names = Json::array();
    for (std::size_t k = 0; k < morphing_.targets.size(); ++k) names.push_back("shape " + std::to_string(k));
    Json& extras = document_.json["meshes"][own]["extras"];
    if (!extras.is_object()) extras = Json::object();
    extras["targetNames"] = std::move(names);
    const std::string warning = "the file's own morph targets are left out of what the clip moves";
    if (had_targets && std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
}

Output Morpher::run(std::vector<std::string>& warnings) && {
    MeshUsers users(document_.json);
    warnings = let_go_of_motion(document_.json, users, scene_.blocks);
    std::vector<std::size_t> nodes;
    for (std::size_t first = 0, last = 0; first < scene_.blocks.size(); first = last) {
        const auto begin = scene_.blocks.begin();
        while (last < scene_.blocks.size() && scene_.blocks[last].node == scene_.blocks[first].node) ++last;
        const auto at = [&](std::size_t b) { return begin + static_cast<std::ptrdiff_t>(b); };
        if (std::none_of(at(first), at(last), [&](const Block& block) { return moves(block); })) continue;
        morph(first, last, users, warnings);
        nodes.push_back(scene_.blocks[first].node);
    }
    animate(document_, morphing_, nodes);
    Output output{std::move(json_), std::move(buffer_)};
    drop_unused(output, base_->json);
    return output;
}

}  // namespace

}  // namespace gltf

namespace {

template <class T>
bool all_finite(std::span<const T> values) {
    return std::ranges::all_of(values, [](const T& value) {
        const float* floats = glm::value_ptr(value);
        return std::all_of(floats, floats + sizeof(T) / sizeof(float),
                           [](float f) { return std::isfinite(f); });
    });
}

/// Throws Error unless sizes fit together and all values are finite.
void check(const Morphing& morphing, std::size_t entries) {
    const std::size_t keys = morphing.times.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == keys; };
    bool good = keys > 0 && morphing.weights.size() == keys * morphing.targets.size() &&
                fits(morphing.translations.size()) && fits(morphing.rotations.size());
    for (const MorphTarget& target : morphing.targets)
        good = good && target.positions.size() == entries &&
               (target.normals.empty() || target.normals.size() == entries);
    for (std::size_t key = 1; key < keys; ++key) good = good && morphing.times[key - 1] < morphing.times[key];
    if (!good)
        throw Error("keys and targets do not fit together; give each target a value for all " +
                    std::to_string(entries) +
                    " entries, and each key, in ascending order, all of its values");
    const auto finite = [](float value) { return std::isfinite(value); };
    good = std::ranges::all_of(morphing.times, finite) && std::ranges::all_of(morphing.weights, finite) &&
           all_finite(morphing.translations) && all_finite(morphing.rotations);
    for (const MorphTarget& target : morphing.targets)
        good = good && all_finite(target.positions) && all_finite(target.normals);
    if (!good) throw Error("a value of a key or a target is not finite; correct it");
}

}  // namespace

MorphingFile save_morphing(const Mesh& mesh, const Morphing& morphing, const std::filesystem::path& file,
                           io::AtomicFiles& files) {
    const std::string ending = io::ending_of(file);
    if (ending != ".glb" && ending != ".gltf")
        fail(file,
             "the ending is not that of a format with morph targets; give a name that ends in .glb or "
             ".gltf");
    check(mesh, file);
    MorphingFile written;
    std::string bytes;
    try {
        check(morphing, vertex_arrays(mesh).positions.size());
        gltf::Output output = gltf::Morpher(mesh, morphing, file, ending == ".glb").run(written.warnings);
        written.animated = output.json.contains("animations");
        bytes = ending == ".glb" ? gltf::glb_file(std::move(output.json), output.buffer)
                                 : gltf::gltf_file(std::move(output.json), output.buffer);
    } catch (const Error& error) {
        fail(file, error.what());
    }
    files.add(file).write(bytes);
    written.bytes = bytes.size();
    return written;
}

}  // namespace goffer::mesh
