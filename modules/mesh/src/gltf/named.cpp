// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "format.hpp"
#include "gltf.hpp"

#include <cstring>

/// The files that a glTF document names, without reading them.

namespace goffer::mesh {
namespace {

/// The document in the bytes of a .gltf or .glb; empty where there is none.
std::string_view document_in(std::string_view bytes) {
    constexpr std::size_t header = 20;  // of a GLB, with that of its first chunk
    if (!bytes.starts_with("glTF")) return bytes;
    if (bytes.size() < header) return {};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return bytes.substr(header, length);
}

/// Empty where it is no document, of which load() says more.
gltf::Json parsed(std::string_view document) {
    gltf::Json json = gltf::Json::parse(document, nullptr, false);
    return json.is_object() ? json : gltf::Json::object();
}

}  // namespace

std::vector<std::filesystem::path> named_buffers(const std::filesystem::path& file,
                                                 const LoadOptions& options) {
    std::vector<std::filesystem::path> named;
    Budget budget(options.limits);
    const std::string bytes = read_bytes(file, budget);
    const std::size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    if (!bytes.starts_with("glTF") && (first == bytes.npos || bytes[first] != '{')) return named;
    const gltf::Json json = parsed(document_in(bytes));
    const auto buffers = json.find("buffers");
    if (buffers == json.end() || !buffers->is_array()) return named;
    const io::NamedFiles files(file, options.allow_outside);
    for (const gltf::Json& buffer : *buffers) {
        const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
        if (uri == buffer.end() || !uri->is_string()) continue;
        const std::string& text = uri->get_ref<const std::string&>();
        if (text.empty() || gltf::is_data_uri(text) || gltf::has_scheme(text)) continue;
        if (const auto place = files.find(gltf::path_of(text))) named.push_back(*place);
    }
    return named;
}

}  // namespace goffer::mesh
