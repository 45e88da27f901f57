// SPDX-License-Identifier: MIT
#include "format.hpp"
#include "gltf.hpp"
#include "text.hpp"

#include <algorithm>
#include <iterator>

namespace goffer::mesh {
namespace {

/// The share of the time by when the document is open: much if its buffers are in its text.
double opening_share(std::string_view bytes) {
    constexpr std::size_t large = 1 << 20;
    return !bytes.starts_with("glTF") && bytes.size() > large ? 0.8 : 0.15;
}

}  // namespace

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file, std::string_view bytes,
                                              std::span<const char* const> lists, const LoadOptions& options,
                                              Budget& budget) {
    try {
        return gltf::named_files(bytes, lists, io::NamedFiles(file, options.allow_outside), budget);
    } catch (const OverLimit&) {
        throw;
    } catch (const Error&) {
        return {};
    }
}

Mesh read_gltf(const std::filesystem::path& file, std::string_view bytes, const LoadOptions& options,
               Budget& budget, const Share& share) {
    try {
        const double opened = opening_share(bytes);
        const auto document = gltf::open_document(file, bytes, options, budget, share.part(0, opened));
        Mesh mesh = gltf::read_scene(*document, budget, share.part(opened, 1)).mesh;
        const auto say = [&](std::vector<std::string> warnings) {
            std::ranges::move(warnings, std::back_inserter(mesh.warnings));
        };
        say(gltf::missing_images(*document));
        if (std::string unknown = gltf::unknown_extensions(*document); !unknown.empty())
            say({std::move(unknown)});
        say(gltf::wrong_types(*document));
        say(gltf::read_textures(document, mesh));
        mesh.source = document;
        return mesh;
    } catch (const OverLimit&) {
        throw;
    } catch (const Error& error) {
        fail(file, error.what());
    }
}

}  // namespace goffer::mesh
