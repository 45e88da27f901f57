// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "format.hpp"
#include "text.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/io/ending.hpp>
#include <goffer/io/read_file.hpp>
#include <goffer/io/text.hpp>
#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <array>

namespace goffer::mesh {
namespace {

namespace fs = std::filesystem;

enum class Format { unknown, obj, ply, stl, glb, gltf };

/// Shares of load()'s time by when its stages are over, roughly.
constexpr double bytes_read = 0.1, mesh_read = 0.95;

constexpr const char* known_endings = ".obj, .ply, .stl, .glb or .gltf";

Format format_of_ending(const fs::path& file) {
    const std::string ending = io::ending_of(file);
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
    if (bytes.starts_with("glTF")) return Format::glb;
    std::string_view text = io::without_bom(bytes);
    if (text.starts_with("ply\n") || text.starts_with("ply\r")) return Format::ply;
    if (is_stl(bytes)) return Format::stl;
    if (is_obj(text)) return Format::obj;
    if (next_token(text).starts_with('{')) return Format::gltf;
    return Format::unknown;
}

Format format_of(const fs::path& file, std::string_view bytes) {
    const Format format = format_of_content(bytes);
    return format == Format::unknown ? format_of_ending(file) : format;
}

Mesh read(const fs::path& file, std::string_view bytes, const LoadOptions& options, Budget& budget,
          const Share& share) {
    switch (format_of(file, bytes)) {
        case Format::obj:
            return read_obj(file, bytes, options, budget, share);
        case Format::ply:
            return read_ply(file, bytes, budget, share);
        case Format::stl:
            return read_stl(file, bytes, budget, share);
        case Format::glb:
        case Format::gltf:
            return read_gltf(file, bytes, options, budget, share);
        case Format::unknown:
            break;
    }
    fail(file, std::string("neither the content nor the ending is that of a mesh; give a ") + known_endings +
                   " file");
}

/// The bytes of a file in that format.
std::string bytes_of(const Mesh& mesh, const fs::path& file, Format format) {
    switch (format) {
        case Format::obj:
            return write_obj(mesh, file);
        case Format::ply:
            return write_ply(mesh);
        case Format::stl:
            return write_stl(mesh);
        case Format::glb:
            return write_glb(mesh, file);
        case Format::gltf:
            return write_gltf(mesh, file);
        case Format::unknown:
            break;
    }
    fail(file, std::string("the ending is not of a known format; give a name that ends in ") + known_endings);
}

}  // namespace

std::string read_bytes(const fs::path& file, Budget& budget, const Share& share) {
    try {
        budget.take(io::size_of_file(file));
        constexpr std::uint64_t steps = 1 << 20;
        Share reading = share.part(0, 1, steps);
        std::string bytes =
            io::read_file(file, [&](double done) { reading.at(static_cast<std::uint64_t>(done * steps)); });
        if (!bytes.empty()) return bytes;
    } catch (const io::Error& error) {
        throw Error(error.what());
    }
    fail(file, "is empty; export the mesh again");
}

Mesh load(const fs::path& file, const LoadOptions& options) {
    try {
        Budget budget(options.limits);
        Listener listener(options.progress);
        const Share all(listener);
        const std::string bytes = read_bytes(file, budget, all.part(0, bytes_read));
        Mesh mesh = read(file, bytes, options, budget, all.part(bytes_read, mesh_read));
        check(mesh, file);
        listener.hear(1);
        return mesh;
    } catch (const OverLimit& error) {
        fail(file, error.what());
    }
}

namespace {

constexpr const char* gltf_lists[] = {"buffers", "images"};

/// `lists`: of a glTF. `materials`: those of an OBJ are wanted.
std::vector<fs::path> files_in(const fs::path& file, std::span<const char* const> lists, bool materials,
                               const LoadOptions& options) {
    try {
        Budget budget(options.limits);
        const std::string bytes = read_bytes(file, budget);
        const Format format = format_of(file, bytes);
        if (format == Format::glb || format == Format::gltf)
            return gltf_files(file, bytes, lists, options, budget);
        return format == Format::obj && materials ? obj_files(file, bytes, options, budget)
                                                  : std::vector<fs::path>{};
    } catch (const OverLimit& error) {
        fail(file, error.what());
    }
}

}  // namespace

std::vector<fs::path> named_buffers(const fs::path& file, const LoadOptions& options) {
    return files_in(file, std::span(gltf_lists).first(1), false, options);
}

std::vector<fs::path> named_files(const fs::path& file, const LoadOptions& options) {
    return files_in(file, gltf_lists, true, options);
}

void save(const Mesh& mesh, const fs::path& file) {
    io::AtomicFiles files;
    save(mesh, file, files);
    files.commit();
}

void save(const Mesh& mesh, const fs::path& file, io::AtomicFiles& files) {
    const Format format = format_of_ending(file);
    if (format != Format::unknown) check(mesh, file);
    const std::string materials = format == Format::obj ? write_mtl(mesh) : std::string();
    if (!materials.empty()) files.add(mtl_beside(file)).write(materials);
    files.add(file).write(bytes_of(mesh, file, format));
}

bool can_save(const fs::path& file) {
    return format_of_ending(file) != Format::unknown;
}

}  // namespace goffer::mesh
