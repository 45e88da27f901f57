// SPDX-License-Identifier: MIT
#include "edit.hpp"

#include "references.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace goffer::mesh::gltf {

namespace {

std::string mime_type(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    if (bytes.starts_with("\xabKTX 20\xbb")) return "image/ktx2";
    return bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP") ? "image/webp" : "";
}

}  // namespace

Json float_fields(const std::vector<float>& values, std::size_t components, bool bounds) {
    Json fields = {{"componentType", float_type}, {"count", values.size() / components}};
    if (bounds) set_bounds(fields, values, components);
    return fields;
}

std::size_t Edit::replace(Replacement replacement) {
    const OwnerAndHash key(replacement.origin, std::hash<std::string>()(replacement.bytes));
    const auto [begin, end] = numbers_.equal_range(key);
    const auto same = std::find_if(begin, end, [&](const auto& known) {
        const Replacement& other = replacements_[known.second];
        return other.target == replacement.target && other.bytes == replacement.bytes &&
               other.fields == replacement.fields;
    });
    const std::size_t number = same != end ? same->second : replacements_.size();
    if (same == end) {
        numbers_.emplace(key, number);
        replacements_.push_back(std::move(replacement));
    }
    return document_.count("accessors") + number;
}

/// Notes that an entry of the output's meshes stands for a mesh of the source.
void Edit::use_entry(std::size_t mesh, std::size_t entry) {
    const Json& primitives = json_["meshes"][entry]["primitives"];
    entries_.emplace(OwnerAndHash(mesh, std::hash<Json>()(primitives)), entry);
}

/// A mesh that an unchanged node shows, maybe in another scene, must stay as it is.
void Edit::keep_shown_elsewhere(const std::vector<Shape>& changed) {
    std::set<std::size_t> nodes, meshes;
    for (const Shape& shape : changed) {
        nodes.insert(shape.node);
        meshes.insert(shape.mesh);
    }
    std::size_t number = 0;
    each(document_.json, "nodes", [&](const Json& node) {
        if (nodes.contains(number++)) return;
        visit_member(node, "mesh", [&](const Json& index) {
            const std::optional<std::size_t> mesh = index_in(index);
            if (mesh && meshes.contains(*mesh) && taken_meshes_.insert(*mesh).second) use_entry(*mesh, *mesh);
        });
    });
}

/// Gives a node a mesh entry with its primitives: one that another node has got, the mesh's own, or a clone.
void Edit::place_one(Shape shape) {
    const OwnerAndHash key(shape.mesh, std::hash<Json>()(shape.primitives));
    const auto [begin, end] = entries_.equal_range(key);
    const auto same = std::find_if(begin, end, [&](const auto& known) {
        return json_["meshes"][known.second]["primitives"] == shape.primitives;
    });
    std::size_t entry = shape.mesh;
    if (same != end) {
        entry = same->second;
    } else {
        if (!taken_meshes_.insert(shape.mesh).second) {
            entry = json_["meshes"].size();
            json_["meshes"].push_back(document_.json["meshes"][shape.mesh]);
        }
        json_["meshes"][entry]["primitives"] = std::move(shape.primitives);
        use_entry(shape.mesh, entry);
    }
    if (entry != shape.mesh) json_["nodes"][shape.node]["mesh"] = entry;
}

void Edit::place(std::vector<Shape> shapes) {
    keep_shown_elsewhere(shapes);
    for (Shape& shape : shapes) place_one(std::move(shape));
}

/// Replacements take the numbers of accessors that nothing uses any more, so that the file does not grow.
void Edit::settle_accessors() {
    const std::size_t count = document_.count("accessors");
    std::set<std::size_t> used = used_accessors(json_);
    std::vector<std::size_t> number;
    std::size_t next = count;
    for (const Replacement& replacement : replacements_) {
        const bool slot_free =
            replacement.origin != Replacement::none && used.insert(replacement.origin).second;
        number.push_back(slot_free ? replacement.origin : next++);
    }
    renumber(number);
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < count) json_["accessors"][number[i]] = Json::object();  // lets go of its views
    }
    std::set<std::size_t> taken_views = used_views(json_);
    for (std::size_t i = 0; i < number.size(); ++i) {
        Json accessor = accessor_for(replacements_[i], taken_views);
        if (number[i] < count) {
            json_["accessors"][number[i]] = std::move(accessor);
        } else {
            json_["accessors"].push_back(std::move(accessor));
        }
    }
}

void Edit::renumber(const std::vector<std::size_t>& number) {
    const std::size_t count = document_.count("accessors");
    const auto settle = [&](Json& index) {
        const bool provisional =
            index.is_number_unsigned() && index >= count && index < count + number.size();
        if (provisional) index = number[index.get<std::size_t>() - count];
    };
    each_accessor_of_mesh(json_, settle);
}

/// The origin's fields with new values, in the origin's view if nothing else uses that any more.
Json Edit::accessor_for(Replacement& replacement, std::set<std::size_t>& taken_views) {
    Json accessor = Json::object(), view = Json::object();
    std::optional<std::size_t> slot;
    if (replacement.origin != Replacement::none) {
        const Value origin = document_.root()["accessors"][replacement.origin];
        accessor = origin.json();
        if (origin.has("bufferView") && taken_views.insert(origin["bufferView"].whole()).second)
            slot = origin["bufferView"].whole();
    }
    if (slot) view = document_.json["bufferViews"][*slot];
    view["target"] = replacement.target;
    accessor["bufferView"] = add_view(std::move(replacement.bytes), std::move(view), slot);
    for (const char* key : {"byteOffset", "normalized", "sparse", "min", "max"}) accessor.erase(key);
    accessor.update(replacement.fields);
    return accessor;
}

std::size_t Edit::add_view(std::string bytes, Json view, std::optional<std::size_t> slot) {
    if (!json_.contains("bufferViews")) json_["bufferViews"] = Json::array();
    Json& views = json_["bufferViews"];
    const std::size_t number = slot.value_or(views.size());
    view["buffer"] = 0;
    view["byteLength"] = bytes.size();
    view.erase("byteStride");
    if (number == views.size()) {
        views.push_back(std::move(view));
    } else {
        views[number] = std::move(view);
    }
    new_views_[number] = std::move(bytes);
    return number;
}

void Edit::settle_images(const std::filesystem::path& file, bool embed) {
    if (!json_.contains("images") || !json_["images"].is_array()) return;
    std::map<std::filesystem::path, std::pair<std::string, std::size_t>> taken;  // type and view of a file
    std::uint64_t room = document_.limits.memory;
    for (std::size_t i = 0; i < json_["images"].size(); ++i) {
        Json image = json_["images"][i];
        if (!image.contains("uri") || !image["uri"].is_string()) continue;
        const auto uri = image["uri"].get<std::string>();
        std::error_code error;
        if (is_data_uri(uri) || has_scheme(uri)) continue;
        const std::filesystem::path named = document_.files.folder() / path_of(uri);
        if (!std::filesystem::is_regular_file(named, error)) continue;
        const std::uint64_t size = std::filesystem::file_size(named, error);
        if (!embed || error || size > room) {  // it stays a name, whether it may be read or not
            const auto from = std::filesystem::weakly_canonical(named, error);
            const auto to =
                std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path(), error);
            if (to != std::filesystem::weakly_canonical(
                          std::filesystem::absolute(document_.files.folder() / "."), error)) {
                const std::filesystem::path way = from.lexically_relative(to);
                if (!way.empty()) json_["images"][i]["uri"] = uri_of(way);
            }
            continue;
        }
        const auto readable = document_.files.find(path_of(uri));
        if (!readable) continue;
        const auto [entry, is_new] = taken.try_emplace(std::filesystem::weakly_canonical(*readable, error));
        auto& [type, view] = entry->second;
        if (is_new) {
            room -= size;
            std::ifstream stream(*readable, std::ios::binary);
            std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
            type = mime_type(bytes);
            if (!type.empty()) view = add_view(std::move(bytes), Json::object(), std::nullopt);
        }
        if (type.empty()) continue;  // a GLB cannot hold it
        image.erase("uri");
        image["mimeType"] = type;
        image["bufferView"] = view;
        json_["images"][i] = std::move(image);
    }
}

/// Packs all views into one buffer: the bytes that stay, then the new ones.
std::string Edit::pack() {
    std::string packed;
    if (json_.contains("bufferViews"))
        packed = pack_views(json_["bufferViews"], document_.buffers,
                            [&](std::size_t view) { return new_views_.contains(view); });
    for (const auto& [number, bytes] : new_views_) {
        packed.resize((packed.size() + 3) / 4 * 4, '\0');
        json_["bufferViews"][number]["byteOffset"] = packed.size();
        packed += bytes;
    }
    return packed;
}

Output Edit::finish() && {
    std::string buffer = pack();
    return {std::move(json_), std::move(buffer)};
}

}  // namespace goffer::mesh::gltf
