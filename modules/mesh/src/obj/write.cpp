// SPDX-License-Identifier: MIT
#include "color.hpp"
#include "format.hpp"
#include "obj.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/text.hpp>

#include <algorithm>
#include <fstream>
#include <unordered_map>
#include <unordered_set>

namespace goffer::mesh {
namespace {

void append_vector(std::string& out, const char* keyword, const glm::vec3& value) {
    out += keyword;
    append_all(out, value.x, value.y, value.z);
}

/// Edits the text that a mesh came from: puts in new positions and normals. Lines whose numbers did not
/// change stay as they are, to the byte. Copies of split normals follow the last vn line, and faces refer to
/// them.
class ObjEditor {
public:
    ObjEditor(const ObjSource& source, const Mesh& mesh, const std::filesystem::path& file)
        : from_(source.file), to_(file), mesh_(mesh), was_(source.read), out_(source.text) {
        Statement statement;
        for (std::string_view rest = io::without_bom(source.text); next_statement(rest, statement);)
            take(statement);
    }
    std::string finish() { return out_.finish(); }

private:
    void take(const Statement& statement) {
        if (statement.keyword == "v") replace(statement, mesh_.positions[seen_.v], was_.positions[seen_.v]);
        if (statement.keyword == "vn" && !was_.normals.empty()) take_normal(statement);
        if (statement.keyword == "f") take_face(statement);
        if (statement.keyword == "mtllib") take_libraries(statement);
        seen_.add(statement);
    }

    void replace(const Statement& statement, const glm::vec3& value, const glm::vec3& was) {
        if (value == was) return;
        std::string_view rest = statement.arguments;
        for (int i = 0; i < 3; ++i) out_.replace(next_argument(rest), value[i]);
    }

    void take_normal(const Statement& statement) {
        const auto& values = mesh_.normals.values;
        const std::size_t count = was_.normals.values.size();
        replace(statement, values[seen_.vn], was_.normals.values[seen_.vn]);
        if (seen_.vn + 1 < count) return;
        std::string copies;
        for (std::size_t i = count; i < values.size(); ++i)
            append_vector(copies, statement.windows ? "\r\nvn" : "\nvn", values[i]);
        out_.replace(statement.end, copies);
        seen_.vn += values.size() - count;
    }

    /// Rewrites references to normals that, counted from where they are, now mean another one.
    void take_face(const Statement& statement) {
        std::vector<std::string_view> normals;
        std::string_view rest = statement.arguments;
        for (std::string_view token = next_argument(rest); !token.empty(); token = next_argument(rest))
            normals.push_back(corner_parts(token)[2]);
        if (normals.size() < 3) return;
        for (const std::string_view normal : normals) {
            const std::size_t corner = corner_++;
            if (normal.empty() || mesh_.normals.empty()) continue;
            const std::uint32_t wanted = mesh_.normals.corners[corner];
            if (from_zero(*io::to_integer(normal), seen_.vn) != wanted)
                out_.replace(normal, std::to_string(wanted + 1ull));
        }
    }

    /// Material files, and the textures that they name, stay where they are: the path to them is rewritten if
    /// the output goes into another folder.
    void take_libraries(const Statement& statement) {
        namespace fs = std::filesystem;
        std::error_code error;
        const fs::path old_folder = fs::absolute(from_).parent_path(),
                       folder = fs::absolute(to_).parent_path();
        if (fs::equivalent(old_folder, folder, error)) return;
        for (const std::string_view name : library_names(from_, statement.arguments)) {
            if (fs::path(name).is_absolute() || !fs::exists(old_folder / name, error)) continue;
            const std::string way = fs::relative(old_folder / name, folder, error).generic_string();
            if (!way.empty()) out_.replace(name, way);
        }
    }

    const std::filesystem::path& from_;
    const std::filesystem::path& to_;
    const Mesh& mesh_;
    const Mesh& was_;
    Editor out_;
    Counts seen_;
    std::size_t corner_ = 0;
};

/// The names by which faces choose materials: each is one line, not empty, and unique.
std::vector<std::string> material_names(const Mesh& mesh) {
    std::vector<std::string> names;
    std::unordered_set<std::string> taken;
    std::unordered_map<std::string, int> next;  // number to try for a name that is taken
    for (const Material& material : mesh.materials) {
        const std::string_view said = io::trimmed(material.name);
        const std::string name = said.empty() ? "material" : io::one_line(said);
        std::string unique = name;
        for (int& i = next.try_emplace(name, 2).first->second; !taken.insert(unique).second; ++i)
            unique = name + "_" + std::to_string(i);
        names.push_back(unique);
    }
    return names;
}

/// A name that no material has.
std::string name_of_none(const std::vector<std::string>& names) {
    std::string none = "none";
    for (int i = 2; std::ranges::find(names, none) != names.end(); ++i) none = "none_" + std::to_string(i);
    return none;
}

void append_faces(std::string& out, const Mesh& mesh) {
    const std::vector<std::string> names = material_names(mesh);
    const std::string none = name_of_none(names);
    std::size_t face = 0, corner = 0;
    const auto append_run = [&](std::size_t count) {
        for (const std::size_t end = face + count; face < end; ++face) {
            out += 'f';
            for (const std::size_t stop = corner + mesh.faces[face]; corner < stop; ++corner)
                append_corner(out, mesh, corner);
            out += '\n';
        }
    };
    std::string group;
    std::int32_t material = -1;
    for (const Part& part : mesh.parts) {
        if (const std::string name = io::one_line(part.name); name != group)
            out += "g " + (group = name) + '\n';
        // OBJ has no way back to no material: faces without one that follow faces with one choose a name that
        // has no entry.
        if (part.material != material)
            out += "usemtl " + (part.material < 0 ? none : names[static_cast<std::size_t>(part.material)]) +
                   '\n';
        material = part.material;
        append_run(part.face_count);
    }
    append_run(mesh.faces.size() - face);
}

std::string write_anew(const Mesh& mesh, const std::filesystem::path& file) {
    std::string out = mesh.materials.empty() ? "" : "mtllib " + mtl_beside(file).filename().string() + '\n';
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        append_vector(out, "v", mesh.positions[i]);
        if (!mesh.colors.empty()) {
            const glm::vec4 color = color_as(false, mesh, mesh.colors[i]);
            append_all(out, color.r, color.g, color.b);
        }
        out += '\n';
    }
    if (!mesh.uvs.empty())
        for (const glm::vec2& uv : mesh.uvs[0].values) {
            out += "vt";
            append_all(out, uv.x, uv.y);
            out += '\n';
        }
    for (const glm::vec3& normal : mesh.normals.values) {
        append_vector(out, "vn", normal);
        out += '\n';
    }
    append_faces(out, mesh);
    return out;
}

/// The source of a mesh that has only been bent since it was read from an OBJ file, else null.
const ObjSource* source_of(const Mesh& mesh) {
    const auto* source = dynamic_cast<const ObjSource*>(mesh.source.get());
    return source && only_bent(mesh, source->read) ? source : nullptr;
}

/// The first line of the material files that are written here.
constexpr std::string_view materials_heading = "# Materials written by goffer\n";

/// Whether there is no such file, or one that was written here.
bool free_for_materials(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return true;
    std::string heading(materials_heading.size(), '\0');
    std::ifstream(file, std::ios::binary).read(heading.data(), static_cast<std::streamsize>(heading.size()));
    return heading == materials_heading;
}

}  // namespace

void append_corner(std::string& out, const Mesh& mesh, std::size_t corner) {
    const std::uint32_t vertex = mesh.corners[corner];
    const std::uint32_t uv = mesh.uvs.empty() ? none : value_at(mesh.uvs[0], corner, vertex);
    const std::uint32_t normal = value_at(mesh.normals, corner, vertex);
    append_all(out, vertex + std::uint64_t{1});
    if (uv != none || normal != none) out += '/';
    if (uv != none) append(out, uv + std::uint64_t{1});
    if (normal == none) return;
    out += '/';
    append(out, normal + std::uint64_t{1});
}

std::string write_obj(const Mesh& mesh, const std::filesystem::path& file) {
    if (const ObjSource* source = source_of(mesh)) return ObjEditor(*source, mesh, file).finish();
    return write_anew(mesh, file);
}

/// A file of that name that others wrote may hold the materials of another model.
std::filesystem::path mtl_beside(const std::filesystem::path& obj) {
    const std::string stem = io::one_line(obj.stem().string());
    std::filesystem::path file = std::filesystem::path(obj).replace_filename(stem + ".mtl");
    for (int i = 2; !free_for_materials(file); ++i)
        file.replace_filename(stem + "_" + std::to_string(i) + ".mtl");
    return file;
}

std::string write_mtl(const Mesh& mesh) {
    std::string out;
    if (source_of(mesh)) return out;
    const std::vector<std::string> names = material_names(mesh);
    if (!names.empty()) out = materials_heading;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const glm::vec4& color = mesh.materials[i].base_color;
        out += "newmtl " + names[i] + "\nKd";
        append_all(out, color.r, color.g, color.b);
        out += "\nd";
        append_all(out, color.a);
        out += '\n';
    }
    return out;
}

}  // namespace goffer::mesh
