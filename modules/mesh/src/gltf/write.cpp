// SPDX-License-Identifier: MIT
#include "format.hpp"
#include "gltf.hpp"
#include "text.hpp"

namespace goffer::mesh {

namespace {

gltf::Output output_of(const Mesh& mesh, const std::filesystem::path& file, bool embed) {
    auto kept = gltf::rewritten(mesh, file, embed);
    return kept ? std::move(*kept) : gltf::made(mesh);
}

}  // namespace

std::string write_glb(const Mesh& mesh, const std::filesystem::path& file) {
    try {
        gltf::Output output = output_of(mesh, file, true);
        return gltf::glb_file(std::move(output.json), output.buffer);
    } catch (const Error& error) {
        fail(file, error.what());
    }
}

std::string write_gltf(const Mesh& mesh, const std::filesystem::path& file) {
    try {
        gltf::Output output = output_of(mesh, file, false);
        return gltf::gltf_file(std::move(output.json), output.buffer);
    } catch (const Error& error) {
        fail(file, error.what());
    }
}

}  // namespace goffer::mesh
