// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <algorithm>
#include <array>

namespace goffer::mesh::gltf {
namespace {

struct Compression {
    const char* name;
    /// Takes it out. (gltf-transform, up to version 4.5, does not know KHR_meshopt_compression.)
    const char* tool;
};
constexpr std::array<Compression, 3> compressions{
    {{"KHR_draco_mesh_compression", "gltf-transform copy IN OUT"},
     {"EXT_meshopt_compression", "gltf-transform copy IN OUT"},
     {"KHR_meshopt_compression", "gltfpack -noq -i IN -o OUT"}}};

bool lists(const Json& json, const char* list, const char* name) {
    return json.contains(list) && json[list].is_array() &&
           std::ranges::find(json[list], name) != json[list].end();
}

[[noreturn]] void refuse(const Json& json, const char* list, const Compression& compression) {
    const auto at = std::ranges::find(json[list], compression.name) - json[list].begin();
    Value(json)[list][static_cast<std::size_t>(at)].fail(
        std::string("the mesh is compressed with ") + compression.name +
        ", which cannot be read; decompress it: " + compression.tool);
}

bool carries(const Json& owner, const char* extension) {
    return owner.is_object() && owner.contains("extensions") && owner["extensions"].is_object() &&
           owner["extensions"].contains(extension);
}

bool is_fallback(const Json& buffer, const char* extension) {
    return carries(buffer, extension) && buffer["extensions"][extension].is_object() &&
           buffer["extensions"][extension].value("fallback", Json()) == true;
}

bool has_bytes(const Json& json, const Json& accessor) {
    const bool listed = accessor.is_number_unsigned() && json.contains("accessors") &&
                        json["accessors"].is_array() && accessor < json["accessors"].size();
    if (!listed) return true;  // whoever reads it says what is wrong
    const Json& entry = json["accessors"][accessor.get<std::size_t>()];
    return !entry.is_object() || entry.contains("bufferView") || entry.contains("sparse");
}

/// Whether a value that carries the extension has its data in plain beside.
bool is_plain(const Json& json, const Json& owner, const char* extension) {
    if (is_fallback(owner, extension)) return owner.contains("uri");
    bool plain = true;
    each(owner, "attributes", [&](const Json& accessor) { plain = plain && has_bytes(json, accessor); });
    if (owner.contains("indices")) plain = plain && has_bytes(json, owner["indices"]);
    return plain;
}

/// Calls `visit` for whatever may carry a compression: buffers, their views, primitives.
template <class Document, class Visit>
void each_carrier(Document& json, const Visit& visit) {
    each(json, "buffers", visit);
    each(json, "bufferViews", visit);
    each(json, "meshes", [&](auto& mesh) { each(mesh, "primitives", visit); });
}

void take_out(Json& json, const char* extension) {
    each_carrier(json, [&](Json& owner) {
        if (!carries(owner, extension)) return;
        owner["extensions"].erase(extension);
        if (owner["extensions"].empty()) owner.erase("extensions");
    });
    Json& used = json["extensionsUsed"];
    used.erase(std::ranges::find(used, extension));
    if (used.empty()) json.erase("extensionsUsed");
}

}  // namespace

void use_plain_data(Json& json) {
    for (const Compression& compression : compressions) {
        if (lists(json, "extensionsRequired", compression.name))
            refuse(json, "extensionsRequired", compression);
        if (!lists(json, "extensionsUsed", compression.name)) continue;
        each_carrier(json, [&](const Json& owner) {
            if (carries(owner, compression.name) && !is_plain(json, owner, compression.name))
                refuse(json, "extensionsUsed", compression);
        });
        take_out(json, compression.name);
    }
}

}  // namespace goffer::mesh::gltf
