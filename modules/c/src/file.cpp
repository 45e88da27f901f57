// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <memory>
#include <stdexcept>
#include <vector>

using namespace goffer;
using namespace goffer::c;

struct goffer_file {
    bend::BodyFile file;
    std::vector<goffer_body> bodies;  // one for each level
};

namespace {

goffer_string string_of(std::string_view text) noexcept {
    return {text.data(), text.size()};
}

/// Null where there is no such level.
const bend::BodyFileLevel* level_of(const goffer_file* file, std::size_t level) noexcept {
    return level < goffer_file_level_count(file) ? &file->file.levels[level] : nullptr;
}

bend::Verify verify_of(int verify) {
    constexpr bend::Verify ways[] = {bend::Verify::everything, bend::Verify::checksum, bend::Verify::layout};
    if (verify < GOFFER_VERIFY_EVERYTHING || verify > GOFFER_VERIFY_LAYOUT)
        throw std::invalid_argument("verify: no such way; use one of GOFFER_VERIFY_..");
    return ways[verify];
}

int code_of(bend::FileReason reason) noexcept {
    switch (reason) {
        case bend::FileReason::missing:
            return GOFFER_ERROR_MISSING;
        case bend::FileReason::unreadable:
            return GOFFER_ERROR_SYSTEM;
        case bend::FileReason::version:
        case bend::FileReason::byte_order:
            return GOFFER_ERROR_VERSION;
        case bend::FileReason::alignment:
            return GOFFER_ERROR_ARGUMENT;
        default:
            return GOFFER_ERROR_FILE;
    }
}

/// Null, and *error says what the fault does, where nothing was loaded.
goffer_file* handle_of(std::optional<bend::BodyFile> loaded, const bend::BodyFileFault& fault,
                       goffer_error* error) {
    if (!loaded) return say(error, code_of(fault.reason), bend::describe(fault).c_str()), nullptr;
    auto file = std::make_unique<goffer_file>(goffer_file{std::move(*loaded), {}});
    file->bodies.resize(file->file.levels.size());
    for (std::size_t i = 0; i < file->bodies.size(); ++i) file->bodies[i].body = &file->file.levels[i].body;
    return file.release();
}

}  // namespace

goffer_file* goffer_file_load(const void* bytes, size_t size, int verify, int copy, goffer_error* error) {
    return guarded(error, [&] {
        if (bytes == nullptr && size > 0) throw std::invalid_argument("bytes: null");
        const std::span all(static_cast<const std::byte*>(bytes), size);
        const auto load = copy != 0 ? bend::load_copy : bend::load;
        bend::BodyFileFault fault;
        std::optional<bend::BodyFile> loaded = load(all, &fault, verify_of(verify));
        return handle_of(std::move(loaded), fault, error);
    });
}

goffer_file* goffer_file_open(const char* name, int verify, goffer_error* error) {
    return guarded(error, [&] {
        if (name == nullptr) throw std::invalid_argument("name: null");
        bend::BodyFileFault fault;
        std::optional<bend::BodyFile> loaded = bend::load_file(name, &fault, verify_of(verify));
        return handle_of(std::move(loaded), fault, error);
    });
}

void goffer_file_free(goffer_file* file) {
    delete file;
}

size_t goffer_file_level_count(const goffer_file* file) {
    return file != nullptr ? file->bodies.size() : 0;
}

const goffer_body* goffer_file_body(const goffer_file* file, size_t level) {
    return level < goffer_file_level_count(file) ? &file->bodies[level] : nullptr;
}

goffer_file_draw goffer_file_mesh(const goffer_file* file, size_t level) {
    const bend::BodyFileLevel* const from = level_of(file, level);
    if (from == nullptr) return {};
    const bend::DrawMesh& mesh = from->mesh;
    return {mesh.triangles.data(),
            mesh.triangles.size() / 3,
            mesh.uvs.empty() ? nullptr : &mesh.uvs[0].x,
            mesh.source.empty() ? nullptr : mesh.source.data(),
            mesh.parts.size(),
            bounds_of(from->rest_bounds)};
}

goffer_part goffer_file_part(const goffer_file* file, size_t level, size_t part) {
    const bend::BodyFileLevel* const of = level_of(file, level);
    if (of == nullptr || part >= of->mesh.parts.size()) return {};
    const bend::DrawPart& from = of->mesh.parts[part];
    return {string_of(from.name), from.first_triangle, from.triangle_count, from.material};
}

size_t goffer_file_material_count(const goffer_file* file) {
    return file != nullptr ? file->file.materials.size() : 0;
}

goffer_material goffer_file_material(const goffer_file* file, size_t material) {
    if (material >= goffer_file_material_count(file)) return {};
    const bend::DrawMaterial& from = file->file.materials[material];
    const glm::vec4& c = from.base_color;
    return {string_of(from.name), {c.r, c.g, c.b, c.a}};
}

size_t goffer_file_socket_count(const goffer_file* file) {
    return file != nullptr ? file->file.sockets.size() : 0;
}

goffer_string goffer_file_socket_name(const goffer_file* file, size_t socket) {
    if (socket >= goffer_file_socket_count(file)) return {};
    return string_of(file->file.sockets[socket].name);
}

goffer_string goffer_file_notes(const goffer_file* file) {
    return file != nullptr ? string_of(file->file.notes) : goffer_string{};
}

goffer_sockets* goffer_file_sockets(const goffer_file* file, goffer_error* error) {
    return guarded(error, [&]() -> goffer_sockets* {
        if (file == nullptr) throw std::invalid_argument("file: null");
        return handle_of(bend::Sockets::make(file->file.levels[0].body, file->file.sockets));
    });
}
