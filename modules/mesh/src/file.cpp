// SPDX-License-Identifier: MIT
#include "format.hpp"
#include "text.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

namespace goffer::mesh {
namespace {

namespace fs = std::filesystem;

enum class Format { unknown, obj, ply, stl, glb, gltf };

constexpr const char* known_endings = ".obj, .ply, .stl, .glb or .gltf";

Format format_of_ending(const fs::path& file) {
    const std::string ending = lower(file.extension().string());
    if (ending == ".obj") return Format::obj;
    if (ending == ".ply") return Format::ply;
    if (ending == ".stl") return Format::stl;
    if (ending == ".glb") return Format::glb;
    if (ending == ".gltf") return Format::gltf;
    return Format::unknown;
}

/// Whether the first statement is one of OBJ.
bool is_obj(std::string_view bytes) {
    constexpr std::array keywords{"v", "vn", "vt", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl"};
    while (!bytes.empty()) {
        std::string_view line = next_line(bytes);
        const std::string_view keyword = next_token(line);
        if (keyword.empty() || keyword.starts_with('#')) continue;
        return std::ranges::find(keywords, keyword) != keywords.end();
    }
    return false;
}

Format format_of_content(std::string_view bytes) {
    std::string_view rest = without_bom(bytes);
    if (bytes.starts_with("glTF")) return Format::glb;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return Format::ply;
    if (is_stl(bytes)) return Format::stl;
    if (is_obj(without_bom(bytes))) return Format::obj;
    if (next_token(rest).starts_with('{')) return Format::gltf;
    return Format::unknown;
}

Mesh read(const fs::path& file, std::string_view bytes, const LoadOptions& options) {
    Format format = format_of_content(bytes);
    if (format == Format::unknown) format = format_of_ending(file);
    switch (format) {
        case Format::obj:
            return read_obj(file, bytes, options);
        case Format::ply:
            return read_ply(file, bytes);
        case Format::stl:
            return read_stl(file, bytes);
        case Format::glb:
        case Format::gltf:
            return read_gltf(file, bytes, options);
        case Format::unknown:
            break;
    }
    fail(file, std::string("neither the content nor the ending is that of a mesh; give a ") + known_endings +
                   " file");
}

/// Both files are written before either takes its place.
void save_obj(const Mesh& mesh, const fs::path& file) {
    const std::string materials = write_mtl(mesh);
    io::AtomicFile obj(file);
    obj.write(write_obj(mesh, file));
    if (!materials.empty()) io::write_file(mtl_beside(file), materials);
    obj.commit();
}

}  // namespace

std::string read_bytes(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail(file, "there is no such file; check the name");
    if (fs::is_directory(status)) fail(file, "is a folder; give the name of a mesh file");
    if (!fs::is_regular_file(status)) fail(file, "is not a regular file; copy what it holds into one");
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error && size == 0) fail(file, "is empty; export the mesh again");
    std::ifstream in(file, std::ios::binary);
    std::string bytes(error ? 0 : size, '\0');
    if (error || !in.read(bytes.data(), static_cast<std::streamsize>(size)))
        fail(file, "cannot be read; check its permissions");
    return bytes;
}

Mesh load(const fs::path& file, const LoadOptions& options) {
    const std::string bytes = read_bytes(file);
    Mesh mesh = read(file, bytes, options);
    check(mesh, file);
    return mesh;
}

void save(const Mesh& mesh, const fs::path& file) {
    const Format format = format_of_ending(file);
    if (format == Format::unknown)
        fail(file,
             std::string("the ending is not of a known format; give a name that ends in ") + known_endings);
    check(mesh, file);
    switch (format) {
        case Format::obj:
            return save_obj(mesh, file);
        case Format::ply:
            return io::write_file(file, write_ply(mesh));
        case Format::stl:
            return io::write_file(file, write_stl(mesh));
        case Format::glb:
            return io::write_file(file, write_glb(mesh, file));
        case Format::gltf:
            return io::write_file(file, write_gltf(mesh, file));
        case Format::unknown:
            break;
    }
}

bool can_save(const fs::path& file) {
    return format_of_ending(file) != Format::unknown;
}

}  // namespace goffer::mesh
