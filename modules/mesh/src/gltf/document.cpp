// SPDX-License-Identifier: MIT
#include "gltf.hpp"
#include "text.hpp"

#include <bit>
#include <cstring>
#include <fstream>
#include <limits>

namespace goffer::mesh::gltf {

static_assert(std::endian::native == std::endian::little,
              "glTF's buffers are little-endian and are copied as they are");

namespace {

constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr int deepest = 200;  // writing recurses; no sensible document comes near it
constexpr const char* truncated = "the GLB is cut off or its lengths are wrong; copy or export it again";

std::uint32_t u32(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

struct Container {
    std::string_view json;
    std::string_view binary;  ///< the BIN chunk
    bool has_binary = false;
};

Container split_glb(std::string_view bytes) {
    if (bytes.size() < 12) throw Error(truncated);
    const std::uint32_t version = u32(bytes, 4), length = u32(bytes, 8);
    if (version != 2) {
        throw Error("is GLB version " + std::to_string(version) +
                    "; only 2 can be read, convert it with gltf-pipeline");
    }
    if (length > bytes.size() || length < 20) throw Error(truncated);
    Container parts;
    for (std::size_t at = 12, number = 0; at < length; ++number) {
        if (length - at < 8 || u32(bytes, at) > length - at - 8) throw Error(truncated);
        const std::uint32_t type = u32(bytes, at + 4);
        const std::string_view chunk = bytes.substr(at + 8, u32(bytes, at));
        if ((number == 0) != (type == json_chunk))
            throw Error("the GLB's first chunk alone must be JSON; export it again");
        if (number == 0) parts.json = chunk;
        if (number == 1 && type == binary_chunk) {
            parts.binary = chunk;
            parts.has_binary = true;
        }
        at += 8 + chunk.size();
    }
    return parts;
}

Container parts_of(std::string_view bytes) {
    return bytes.starts_with("glTF") ? split_glb(bytes) : Container{bytes, {}, false};
}

/// Looks at brackets before the parser runs (its callback would take quadratic time for long arrays), and at
/// what its values will take: by what a value, a member and a list are in memory, with the room that lists
/// leave for more.
void check_nesting(std::string_view text, Budget& budget, Share share) {
    constexpr std::uint64_t per_value = 2 * sizeof(Json), per_name = 2 * (sizeof(std::string) + sizeof(Json)),
                            per_list = 4 * sizeof(Json);
    // To look up a member takes time in proportion to how many an object has.
    constexpr double few_lookups = 4e8, per_byte = 64;
    double lookups = 0;
    std::vector<double> members = {0};  // of all that is open
    std::uint64_t bytes = text.size();
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        share.at(i);
        if (c == '"') in_string = !in_string;
        if (in_string && c == '\\') ++i;
        if (in_string) continue;
        if (c == ',') bytes += per_value;
        if (c == ':') bytes += per_name, lookups += members.back()++;
        if (c == '{' || c == '[') bytes += per_list;
        if (c == '}' || c == ']') {
            --depth;
            if (members.size() > 1) members.pop_back();
        }
        if (c == '{' || c == '[') {
            members.push_back(0);
            if (++depth > deepest)
                throw Error("the JSON is nested more than " + std::to_string(deepest) +
                            " deep; remove such extras");
        }
    }
    if (lookups > few_lookups + per_byte * static_cast<double>(text.size()))
        throw Error("the JSON has objects of too many members; remove such extras");
    budget.take(bytes);
}

Json parse(std::string_view text, Budget& budget, const Share& share) {
    check_nesting(text, budget, share.part(0, 1, text.size()));
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw Error("not valid JSON at byte " + std::to_string(error.byte) + "; export the file again");
    } catch (const Json::exception&) {
        throw Error("the JSON has a number that no double can hold; correct or remove it");
    }
}

void check_version(const Value& root) {
    const Value version = root["asset"]["version"];
    if (!version.text().starts_with("2.")) {
        version.fail("is " + mesh::quoted(version.text()) +
                     "; only glTF 2 can be read, convert it with gltf-pipeline");
    }
}

/// What to say of a name where there is no file to read, after the name itself.
std::string absent(const std::filesystem::path& place) {
    std::error_code error;
    const bool other = std::filesystem::exists(place, error);
    return std::string(", which is ") + (other ? "no regular file" : "not there") +
           "; put it beside the document";
}

std::string read_outer(const Value& uri, const io::NamedFiles& files, std::uint64_t size, Budget& budget) {
    if (uri.text().empty() || has_scheme(uri.text())) {
        uri.fail("is " + mesh::quoted(uri.text()) +
                 "; only paths are read, so put the file beside the document");
    }
    const std::optional<std::filesystem::path> place = files.find(path_of(uri.text()));
    if (!place) uri.fail("names " + mesh::quoted(uri.text()) + io::NamedFiles::outside);
    const std::filesystem::path& file = *place;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        uri.fail("names " + mesh::quoted(uri.text()) + absent(file));
    }
    const std::uint64_t present = std::filesystem::file_size(file, error);
    if (error || present < size) {
        uri.fail("names " + mesh::quoted(uri.text()) + ", which has " + std::to_string(error ? 0 : present) +
                 " bytes of " + std::to_string(size) + "; copy it again");
    }
    budget.take(size);
    std::string bytes(size, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
        uri.fail("names " + mesh::quoted(uri.text()) + ", which cannot be read; check its permissions");
    }
    return bytes;
}

std::string read_buffer(const Value& buffer, bool first, const Container& parts, const io::NamedFiles& files,
                        Budget& budget) {
    const std::uint64_t size = buffer["byteLength"].whole();
    const bool named = buffer.has("uri");
    if (named && !is_data_uri(buffer["uri"].text())) return read_outer(buffer["uri"], files, size, budget);
    std::string bytes;
    budget.take(named ? buffer["uri"].text().size() : parts.binary.size());
    if (named) {
        std::optional<std::string> data = data_of(buffer["uri"].text());
        if (!data) buffer["uri"].fail("is not a well-formed data URI; export the file again");
        bytes = std::move(*data);
    } else if (first && parts.has_binary) {  // the BIN chunk is the first buffer's alone
        bytes = parts.binary;
    } else {
        buffer.fail("has neither a \"uri\" nor a GLB's BIN chunk; export the file again");
    }
    if (bytes.size() < size) {
        buffer.fail("has " + std::to_string(bytes.size()) + " bytes of the " + std::to_string(size) +
                    " that byteLength promises; copy or export the file again");
    }
    bytes.resize(size);
    return bytes;
}

void check_view(const Document& document, const Value& view) {
    const Value buffer = document.entry("buffers", view["buffer"]);
    const std::uint64_t offset = view.whole_or("byteOffset", 0), length = view["byteLength"].whole();
    const std::uint64_t size = document.buffers[view["buffer"].whole()].size();
    if (offset > size || length > size - offset) {
        view.fail("spans bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                  " of a buffer of " + std::to_string(size) + "; export the file again");
    }
}

void append_u32(std::string& bytes, std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&narrow), 4);
}

void append_chunk(std::string& bytes, std::uint32_t type, const std::string& data, char padding) {
    const std::size_t padded = (data.size() + 3) / 4 * 4;
    append_u32(bytes, padded);
    append_u32(bytes, type);
    bytes += data;
    bytes.append(padded - data.size(), padding);
}

/// The document's one buffer. Its other fields stay.
void set_buffer(Json& json, const std::string& buffer, const std::string& uri) {
    if (buffer.empty()) {
        json.erase("buffers");
        return;
    }
    Json entry = json.contains("buffers") ? json["buffers"][0] : Json::object();
    entry["byteLength"] = buffer.size();
    if (uri.empty()) {
        entry.erase("uri");
    } else {
        entry["uri"] = uri;
    }
    json["buffers"] = Json::array({std::move(entry)});
}

}  // namespace

std::string_view Document::view(const Value& buffer_view) const {
    const std::string& buffer = buffers[buffer_view["buffer"].whole()];
    return std::string_view(buffer).substr(buffer_view.whole_or("byteOffset", 0),
                                           buffer_view["byteLength"].whole());
}

std::vector<std::filesystem::path> named_files(std::string_view bytes, std::span<const char* const> lists,
                                               const io::NamedFiles& files, Budget& budget) {
    const Json json = parse(parts_of(bytes).json, budget, {});
    std::vector<std::filesystem::path> named;
    const auto take = [&](const Json& element) {
        const bool has_uri = element.is_object() && element.contains("uri") && element["uri"].is_string();
        if (!has_uri) return;
        const std::string& uri = element["uri"].get_ref<const std::string&>();
        if (uri.empty() || is_data_uri(uri) || has_scheme(uri)) return;
        if (const auto place = files.find(path_of(uri))) named.push_back(*place);
    };
    for (const char* const list : lists) each(json, list, take);
    return named;
}

std::string unknown_extensions(const Document& document) {
    // What these change is no geometry, or is read.
    constexpr std::array<std::string_view, 9> known{
        "KHR_materials_",       "KHR_texture_", "EXT_texture_",   "MSFT_texture_",
        "KHR_lights_",          "KHR_xmp",      "KHR_animation_", "EXT_mesh_gpu_instancing",
        "KHR_mesh_quantization"};
    std::string unknown;
    each(document.json, "extensionsRequired", [&](const Json& name) {
        const bool is_text = name.is_string();
        const std::string text = is_text ? name.get<std::string>() : std::string();
        const auto begins = [&](std::string_view begin) { return text.starts_with(begin); };
        if (is_text && unknown.empty() && std::ranges::none_of(known, begins)) unknown = text;
    });
    return unknown.empty() ? unknown
                           : "extensionsRequired names " + mesh::quoted(unknown) +
                                 ", which goffer does not know: what it changes is not looked at";
}

std::shared_ptr<const Document> open_document(const std::filesystem::path& file, std::string_view bytes,
                                              const LoadOptions& options, Budget& budget,
                                              const Share& share) {
    const Container parts = parts_of(bytes);
    const auto document = std::make_shared<Document>(io::NamedFiles(file, options.allow_outside));
    document->limits = options.limits;
    document->json = parse(parts.json, budget, share.part(0, 0.3));
    const Value root = document->root();
    check_version(root);
    use_plain_data(document->json);
    Share reading = share.part(0.5, 1, document->count("buffers"));
    for (std::size_t i = 0; i < document->count("buffers"); ++i) {
        reading.at(i);
        document->buffers.push_back(read_buffer(root["buffers"][i], i == 0, parts, document->files, budget));
    }
    for (std::size_t i = 0; i < document->count("bufferViews"); ++i)
        check_view(*document, root["bufferViews"][i]);
    return document;
}

std::vector<std::string> missing_images(const Document& document) {
    std::vector<std::string> missing;
    const bool listed = document.json.contains("images") && document.json["images"].is_array();
    for (std::size_t i = 0; listed && i < document.json["images"].size(); ++i) {
        const Json& image = document.json["images"][i];
        if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) continue;
        const Value uri = document.root()["images"][i]["uri"];
        if (is_data_uri(uri.text()) || has_scheme(uri.text())) continue;
        std::error_code error;
        const std::string names = uri.path() + " names " + mesh::quoted(uri.text());
        const std::optional<std::filesystem::path> place = document.files.find(path_of(uri.text()));
        if (!place) {
            missing.push_back("a texture is not looked at: " + names + io::NamedFiles::outside);
        } else if (!std::filesystem::is_regular_file(*place, error)) {
            missing.push_back("a texture is missing: " + names + absent(*place));
        }
    }
    constexpr std::size_t most = 20;
    if (missing.size() > most) {
        const std::size_t more = missing.size() - most;
        missing.resize(most);
        missing.push_back(std::to_string(more) + " more images are missing or are not looked at");
    }
    return missing;
}

std::shared_ptr<const Document> document_of(Output output, const Document& origin) {
    const auto document = std::make_shared<Document>(origin.files);
    document->limits = origin.limits;
    document->json = std::move(output.json);
    set_buffer(document->json, output.buffer, "");
    if (!output.buffer.empty()) document->buffers.push_back(std::move(output.buffer));
    return document;
}

std::string glb_file(Json json, const std::string& buffer) {
    set_buffer(json, buffer, "");
    // Names need not be UTF-8, which `replace` makes them.
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::size_t length =
        12 + 8 + (text.size() + 3) / 4 * 4 + (buffer.empty() ? 0 : 8 + (buffer.size() + 3) / 4 * 4);
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw Error("a GLB holds 4 GiB at most; save as .gltf or .ply");
    std::string bytes = "glTF";
    bytes.reserve(length);
    append_u32(bytes, 2);
    append_u32(bytes, length);
    append_chunk(bytes, json_chunk, text, ' ');
    if (!buffer.empty()) append_chunk(bytes, binary_chunk, buffer, '\0');
    return bytes;
}

std::string gltf_file(Json json, const std::string& buffer) {
    set_buffer(json, buffer, buffer.empty() ? "" : data_uri("application/octet-stream", buffer));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace goffer::mesh::gltf
