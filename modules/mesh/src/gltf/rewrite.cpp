// SPDX-License-Identifier: MIT
#include "edit.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace goffer::mesh::gltf {

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class T>
bool same_shape(const Attribute<T>& a, const Attribute<T>& b) {
    return a.values.size() == b.values.size() && same_bits(a.corners, b.corners);
}

/// Whether `mesh` is the scene of its source but for the values of its streams. Bits are compared, since a UV
/// that is NaN must not make a difference. Nothing is ever split here, since glTF's streams share one index.
bool same_but_streams(const Mesh& mesh, const Mesh& rest) {
    bool same = mesh.positions.size() == rest.positions.size() && same_shape(mesh.normals, rest.normals) &&
                same_shape(mesh.tangents, rest.tangents) && same_bits(mesh.colors, rest.colors) &&
                same_bits(mesh.corners, rest.corners) && same_bits(mesh.faces, rest.faces) &&
                mesh.parts == rest.parts && mesh.materials == rest.materials &&
                mesh.uvs.size() == rest.uvs.size();
    for (std::size_t i = 0; same && i < rest.uvs.size(); ++i) {
        same = same_bits(mesh.uvs[i].values, rest.uvs[i].values) &&
               same_bits(mesh.uvs[i].corners, rest.uvs[i].corners);
    }
    return same;
}

/// A value of a stream, taken back to the node's space.
template <Stream stream>
auto brought_back(const Mesh& mesh, const Placement& placement, std::size_t i) {
    if constexpr (stream == position) return placement.point_back(mesh.positions[i]);
    if constexpr (stream == normal) return placement.normal_back(mesh.normals.values[i]);
    if constexpr (stream == tangent) return placement.tangent_back(mesh.tangents.values[i]);
}

template <Stream stream>
const auto& values_of(const Mesh& mesh) {
    if constexpr (stream == position) return mesh.positions;
    if constexpr (stream == normal) return mesh.normals.values;
    if constexpr (stream == tangent) return mesh.tangents.values;
}

/// What a block's accessor is to hold; empty if it stays as it is. `stored` is what it holds now. A value
/// that bending did not change keeps its stored bits, and so does a normal or tangent that became unusable.
template <Stream stream>
std::vector<float> changed(const Mesh& mesh, const Mesh& rest, const Block& block,
                           std::vector<float> stored) {
    constexpr std::size_t width = stream_width[stream];
    bool any = false;
    for (std::size_t i = 0; i < block.count; ++i) {
        const auto &now = values_of<stream>(mesh)[block.first[stream] + i],
                   &was = values_of<stream>(rest)[block.first[stream] + i];
        if (now == was) continue;
        const auto local = brought_back<stream>(mesh, block.placement, block.first[stream] + i);
        const float* value = glm::value_ptr(local);
        const bool finite = std::all_of(value, value + width, [](float v) { return std::isfinite(v); });
        if (stream == position && !finite) {
            throw Error("vertex " + std::to_string(block.first[stream] + i) +
                        " is too far away for its node's scale; bend less, or scale the file");
        }
        if (!finite || (value[0] == 0.0f && value[1] == 0.0f && value[2] == 0.0f && stream != position))
            continue;
        std::copy(value, value + width, stored.begin() + static_cast<std::ptrdiff_t>(i * width));
        any = true;
    }
    return any ? stored : std::vector<float>{};
}

class Rewriter {
public:
    Rewriter(const Document& document, const Mesh& mesh)
        : document_(document), mesh_(mesh), edit_(document) {}

    /// Returns null if the mesh differs from the source in more than its streams.
    std::optional<Output> run(const std::filesystem::path& file, bool embed) &&;

private:
    template <Stream stream>
    void replace(const Block& block, const Mesh& rest, Json& primitives);
    [[nodiscard]] std::vector<Shape> shapes(const Scene& scene);

    const Document& document_;
    const Mesh& mesh_;
    Edit edit_;
};

template <Stream stream>
void Rewriter::replace(const Block& block, const Mesh& rest, Json& primitives) {
    if (block.first[stream] == Block::absent || values_of<stream>(rest).empty() || block.placement.singular())
        return;
    const Value attributes =
        document_.root()["meshes"][block.mesh]["primitives"][block.primitives[0]]["attributes"];
    const Value reference = attributes[stream_name[stream]];
    const std::size_t origin = reference.whole();
    std::vector<float> values =
        changed<stream>(mesh_, rest, block, read_floats(document_, reference, stream_width[stream]));
    if (values.empty()) return;
    Json fields = float_fields(values, stream_width[stream], stream == position);
    const std::size_t number = edit_.replace({origin, std::move(fields), bytes_of(values)});
    for (const std::size_t i : block.primitives) primitives[i]["attributes"][stream_name[stream]] = number;
}

std::vector<Shape> Rewriter::shapes(const Scene& scene) {
    std::vector<Shape> all;
    for (const Block& block : scene.blocks) {
        if (all.empty() || all.back().node != block.node) {
            all.push_back({block.node, block.mesh, document_.json["meshes"][block.mesh]["primitives"]});
        }
        replace<position>(block, scene.mesh, all.back().primitives);
        replace<normal>(block, scene.mesh, all.back().primitives);
        replace<tangent>(block, scene.mesh, all.back().primitives);
    }
    return all;
}

std::optional<Output> Rewriter::run(const std::filesystem::path& file, bool embed) && {
    const Scene scene = read_scene(document_);
    if (!same_but_streams(mesh_, scene.mesh)) return std::nullopt;
    std::vector<Shape> bent = shapes(scene);
    std::erase_if(
        bent, [&](const Shape& s) { return s.primitives == document_.json["meshes"][s.mesh]["primitives"]; });
    edit_.place(std::move(bent));
    edit_.settle_accessors();
    edit_.settle_images(file, embed);
    return std::move(edit_).finish();
}

}  // namespace

std::optional<Output> rewritten(const Mesh& mesh, const std::filesystem::path& file, bool embed) {
    const auto* document = dynamic_cast<const Document*>(mesh.source.get());
    return document ? Rewriter(*document, mesh).run(file, embed) : std::nullopt;
}

}  // namespace goffer::mesh::gltf
