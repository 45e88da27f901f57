// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

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

/// Whether `mesh` is the scene of its source but for the values of its streams. Bits are compared: a UV that
/// is nan must not cost the document. Nothing is ever split here, since glTF's streams have one index.
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

/// A value of a stream as floats, and its way back to the node's space.
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

/// What a block's accessor is to hold; empty where it stays. `stored` is what it holds. A value that bending
/// left alone keeps its stored bits, and one that bending made unusable does, too.
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
            throw Error(
                "vertex " + std::to_string(block.first[stream] + i) +
                " is too far away for its node's scale, nothing is written; bend less or scale the file");
        }
        if (!finite || (value[0] == 0.0f && value[1] == 0.0f && value[2] == 0.0f && stream != position))
            continue;
        std::copy(value, value + width, stored.begin() + static_cast<std::ptrdiff_t>(i * width));
        any = true;
    }
    return any ? stored : std::vector<float>{};
}

void add_number(const Json& json, std::set<std::size_t>& found) {
    const double value = json.is_number() ? json.get<double>() : -1.0;
    if (value >= 0.0 && value <= 1e15 && value == std::floor(value))
        found.insert(static_cast<std::size_t>(value));
}

bool names_no_accessors(std::string_view extension) {
    for (const char* kind :
         {"KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "MSFT_texture_"}) {
        if (extension.starts_with(kind)) return true;
    }
    return false;
}

/// All numbers inside other extensions, which might be indices of anything: we can't know, and rather keep
/// too much.
void numbers_in_extensions(const Json& json, bool inside, std::set<std::size_t>& found) {
    if (inside) add_number(json, found);
    if (json.is_array()) {
        for (const Json& child : json) numbers_in_extensions(child, inside, found);
    } else if (json.is_object()) {
        for (const auto& [key, child] : json.items()) {
            if (!names_no_accessors(key)) numbers_in_extensions(child, inside || key == "extensions", found);
        }
    }
}

/// Adds what `owner` names under `key`, if it does.
void add_index(const Json& owner, const char* key, std::set<std::size_t>& found) {
    if (owner.is_object() && owner.contains(key)) add_number(owner[key], found);
}

/// Calls `visit` for each element of owner[key], where that is an array or object.
template <class Owner, class Visit>
void each(Owner& owner, const char* key, Visit&& visit) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_structured()) return;
    for (auto& element : owner[key]) visit(element);
}

std::set<std::size_t> used_accessors(const Json& json) {
    std::set<std::size_t> used;
    const auto add = [&](const Json& index) { add_number(index, used); };
    each(json, "meshes", [&](const Json& mesh) {
        each(mesh, "primitives", [&](const Json& primitive) {
            add_index(primitive, "indices", used);
            each(primitive, "attributes", add);
            each(primitive, "targets", [&](const Json& target) {
                if (target.is_structured()) std::for_each(target.begin(), target.end(), add);
            });
        });
    });
    each(json, "skins", [&](const Json& skin) { add_index(skin, "inverseBindMatrices", used); });
    each(json, "animations", [&](const Json& animation) {
        each(animation, "samplers", [&](const Json& sampler) {
            add_index(sampler, "input", used);
            add_index(sampler, "output", used);
        });
    });
    numbers_in_extensions(json, false, used);
    return used;
}

std::set<std::size_t> used_views(const Json& json) {
    std::set<std::size_t> used;
    each(json, "images", [&](const Json& image) { add_index(image, "bufferView", used); });
    each(json, "accessors", [&](const Json& accessor) {
        add_index(accessor, "bufferView", used);
        each(accessor, "sparse", [&](const Json& part) { add_index(part, "bufferView", used); });
    });
    numbers_in_extensions(json, false, used);
    return used;
}

/// An accessor that takes over for `origin`. Until all are known it goes by a number behind the document's
/// own.
struct Replacement {
    std::size_t origin;
    Stream stream;
    std::vector<float> values;
};

/// A node's mesh as it is to be: its primitives, with the numbers of replacements.
struct Shape {
    std::size_t node, mesh;
    Json primitives;
};

class Rewriter {
public:
    Rewriter(const Document& document, const Mesh& mesh)
        : document_(document), mesh_(mesh), json_(document.json) {}

    /// Null where the mesh isn't the source's any more.
    std::optional<Output> run(const std::filesystem::path& file, bool embed) &&;

private:
    template <Stream stream>
    void replace(const Block& block, const Mesh& rest, Json& primitives);
    [[nodiscard]] std::vector<Shape> shapes(const Scene& scene);
    void place(Shape shape);
    void keep_shown_elsewhere(const std::vector<Shape>& bent);
    void settle_accessors();
    void renumber(const std::vector<std::size_t>& number);
    Json accessor_for(const Replacement& replacement, std::set<std::size_t>& taken_views);
    std::size_t add_view(std::string bytes, Json view, std::optional<std::size_t> slot);
    void settle_images(const std::filesystem::path& file, bool embed);
    [[nodiscard]] std::string pack();

    const Document& document_;
    const Mesh& mesh_;
    Json json_;
    std::vector<Replacement> replacements_;
    std::map<std::size_t, std::string> new_views_;  ///< bytes, by the view's number
    std::map<std::size_t, std::vector<std::size_t>>
        mesh_entries_;  ///< of each source mesh: entries in use, first its own
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
    const auto same = std::find_if(replacements_.begin(), replacements_.end(), [&](const Replacement& other) {
        return other.origin == origin && other.stream == stream && same_bits(other.values, values);
    });
    const std::size_t number =
        document_.count("accessors") + static_cast<std::size_t>(same - replacements_.begin());
    if (same == replacements_.end()) replacements_.push_back({origin, stream, std::move(values)});
    for (const std::size_t i : block.primitives) primitives[i]["attributes"][stream_name[stream]] = number;
}

/// A mesh that a node shows which isn't bent, maybe in another scene, must stay as it is.
void Rewriter::keep_shown_elsewhere(const std::vector<Shape>& bent) {
    std::set<std::size_t> nodes;
    for (const Shape& shape : bent) nodes.insert(shape.node);
    std::size_t number = 0;
    each(document_.json, "nodes", [&](const Json& node) {
        std::set<std::size_t> shown;
        if (!nodes.contains(number++)) add_index(node, "mesh", shown);
        for (const std::size_t mesh : shown) mesh_entries_[mesh] = {mesh};
    });
}

/// Gives a node an entry with its primitives: one that another node has already, the mesh's own, or a clone.
void Rewriter::place(Shape shape) {
    std::vector<std::size_t>& entries = mesh_entries_[shape.mesh];
    const auto same = std::find_if(entries.begin(), entries.end(), [&](std::size_t entry) {
        return json_["meshes"][entry]["primitives"] == shape.primitives;
    });
    std::size_t entry = shape.mesh;
    if (same != entries.end()) {
        entry = *same;
    } else {
        if (!entries.empty()) {
            entry = json_["meshes"].size();
            json_["meshes"].push_back(document_.json["meshes"][shape.mesh]);
        }
        json_["meshes"][entry]["primitives"] = std::move(shape.primitives);
        entries.push_back(entry);
    }
    if (entry != shape.mesh) json_["nodes"][shape.node]["mesh"] = entry;
}

/// Replacements take the numbers of accessors that nothing uses any more, so that the file doesn't grow.
void Rewriter::settle_accessors() {
    const std::size_t count = document_.count("accessors");
    std::set<std::size_t> used = used_accessors(json_);
    std::vector<std::size_t> number;
    std::size_t next = count;
    for (const Replacement& replacement : replacements_) {
        const bool slot_free = used.insert(replacement.origin).second;
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

void Rewriter::renumber(const std::vector<std::size_t>& number) {
    const std::size_t count = document_.count("accessors");
    each(json_, "meshes", [&](Json& mesh) {
        each(mesh, "primitives", [&](Json& primitive) {
            each(primitive, "attributes", [&](Json& index) {
                const bool provisional =
                    index.is_number_unsigned() && index >= count && index < count + number.size();
                if (provisional) index = number[index.get<std::size_t>() - count];
            });
        });
    });
}

/// The origin's fields with new values, in the origin's own view where nothing else uses that any more.
Json Rewriter::accessor_for(const Replacement& replacement, std::set<std::size_t>& taken_views) {
    const Value origin = document_.root()["accessors"][replacement.origin];
    std::optional<std::size_t> slot;
    if (origin.has("bufferView") && taken_views.insert(origin["bufferView"].whole()).second)
        slot = origin["bufferView"].whole();
    Json view = slot ? document_.json["bufferViews"][*slot] : Json::object();
    view["target"] = 34962;  // vertex attributes
    Json accessor = origin.json();
    accessor["bufferView"] = add_view(bytes_of(replacement.values), std::move(view), slot);
    for (const char* key : {"byteOffset", "normalized", "sparse", "min", "max"}) accessor.erase(key);
    accessor["componentType"] = 5126;  // float
    if (replacement.stream == position) set_bounds(accessor, replacement.values, stream_width[position]);
    return accessor;
}

std::size_t Rewriter::add_view(std::string bytes, Json view, std::optional<std::size_t> slot) {
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

std::string mime_type(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    if (bytes.starts_with("\xabKTX 20\xbb")) return "image/ktx2";
    return bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP") ? "image/webp" : "";
}

/// Images beside the source are taken in or named from the new place; those that aren't there keep their URI.
void Rewriter::settle_images(const std::filesystem::path& file, bool embed) {
    if (!json_.contains("images") || !json_["images"].is_array()) return;
    for (std::size_t i = 0; i < json_["images"].size(); ++i) {
        Json image = json_["images"][i];
        if (!image.contains("uri") || !image["uri"].is_string()) continue;
        const auto uri = image["uri"].get<std::string>();
        std::error_code error;
        const std::filesystem::path outer = document_.folder / path_of(uri);
        if (is_data_uri(uri) || !is_relative_uri(uri) || !std::filesystem::is_regular_file(outer, error))
            continue;
        if (!embed) {
            const auto from = std::filesystem::weakly_canonical(outer, error);
            const auto to =
                std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path(), error);
            if (to != std::filesystem::weakly_canonical(std::filesystem::absolute(document_.folder), error)) {
                const std::filesystem::path way = from.lexically_relative(to);
                if (!way.empty()) json_["images"][i]["uri"] = uri_of(way);
            }
            continue;
        }
        std::ifstream stream(outer, std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        const std::string type = mime_type(bytes);
        if (type.empty()) continue;  // not an image that a GLB can hold
        image.erase("uri");
        image["mimeType"] = type;
        image["bufferView"] = add_view(std::move(bytes), Json::object(), std::nullopt);
        json_["images"][i] = std::move(image);
    }
}

/// Where bytes of the source's buffers go in the one buffer of the output.
struct Kept {
    std::size_t buffer, begin, end, to = 0;
};

/// What the views that stay use of the buffers, from front to back, overlapping ones as one.
std::vector<Kept> kept_ranges(const Document& document, const std::map<std::size_t, std::string>& replaced) {
    std::vector<Kept> all, merged;
    for (std::size_t i = 0; i < document.count("bufferViews"); ++i) {
        if (replaced.contains(i)) continue;
        const Value view = document.root()["bufferViews"][i];
        const std::size_t begin = view.whole_or("byteOffset", 0);
        all.push_back({view["buffer"].whole(), begin, begin + view["byteLength"].whole()});
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) {
        return std::tie(a.buffer, a.begin, a.end) < std::tie(b.buffer, b.begin, b.end);
    });
    for (const Kept& range : all) {
        const bool joins =
            !merged.empty() && merged.back().buffer == range.buffer && range.begin <= merged.back().end;
        if (joins) {
            merged.back().end = std::max(merged.back().end, range.end);
        } else {
            merged.push_back(range);
        }
    }
    return merged;
}

/// All views in one buffer: the bytes that stay in their order (and at the same place modulo 4), then the new
/// ones.
std::string Rewriter::pack() {
    std::string packed;
    std::vector<Kept> kept = kept_ranges(document_, new_views_);
    for (Kept& range : kept) {
        packed.resize(packed.size() + (range.begin - packed.size()) % 4, '\0');
        range.to = packed.size();
        packed +=
            std::string_view(document_.buffers[range.buffer]).substr(range.begin, range.end - range.begin);
    }
    for (std::size_t i = 0; i < document_.count("bufferViews"); ++i) {
        if (new_views_.contains(i)) continue;
        const Value view = document_.root()["bufferViews"][i];
        const std::size_t buffer = view["buffer"].whole(), begin = view.whole_or("byteOffset", 0);
        const auto behind =
            std::upper_bound(kept.begin(), kept.end(), std::pair(buffer, begin),
                             [](const auto& at, const Kept& k) { return at < std::pair(k.buffer, k.begin); });
        const Kept& range = *std::prev(behind);
        Json& moved = json_["bufferViews"][i];
        if (buffer != 0) moved["buffer"] = 0;
        const std::size_t to = range.to + begin - range.begin;
        if (to != begin) moved["byteOffset"] = to;
    }
    for (const auto& [number, bytes] : new_views_) {
        packed.resize((packed.size() + 3) / 4 * 4, '\0');
        json_["bufferViews"][number]["byteOffset"] = packed.size();
        packed += bytes;
    }
    return packed;
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
    keep_shown_elsewhere(bent);
    for (Shape& shape : bent) place(std::move(shape));
    settle_accessors();
    settle_images(file, embed);
    std::string buffer = pack();
    return Output{std::move(json_), std::move(buffer)};
}

}  // namespace

std::optional<Output> rewritten(const Mesh& mesh, const std::filesystem::path& file, bool embed) {
    const auto* document = dynamic_cast<const Document*>(mesh.source.get());
    return document ? Rewriter(*document, mesh).run(file, embed) : std::nullopt;
}

}  // namespace goffer::mesh::gltf
