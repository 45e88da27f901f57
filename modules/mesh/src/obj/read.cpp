// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "format.hpp"
#include "obj.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/named_files.hpp>

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace goffer::mesh {
namespace {

constexpr double counted = 0.2, parsed = 0.9;  ///< shares of the time by when the two passes are over

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, std::string_view text, const LoadOptions& options,
              Budget& budget, const Share& share)
        : file_(file),
          text_(text),
          options_(options),
          files_(file, options.allow_outside),
          budget_(budget),
          share_(share) {}
    Mesh read();

private:
    template <class Take>
    void each_statement(Share share, Take take) const;
    void take(const Statement& statement);
    void take_vertex(const Statement& statement);
    void take_normal(const Statement& statement);
    void take_uv(const Statement& statement);
    void take_face(const Statement& statement);
    void take_material(std::string_view name);
    void begin_part();

    std::size_t numbers(const Statement& statement, std::size_t needed);
    float finite_or_zero(float value);
    std::uint32_t index(std::string_view token, std::size_t seen, std::size_t total, const char* what) const;
    void drop_unused_attributes();
    void read_library(const std::filesystem::path& library, std::vector<tinyobj::material_t>& found);
    void warn_of_textures(const std::filesystem::path& library,
                          std::span<const tinyobj::material_t> materials);
    void find_textures(const std::filesystem::path& library, std::span<const tinyobj::material_t> materials);
    std::vector<tinyobj::material_t> read_libraries();
    void read_materials();
    [[noreturn]] void fail_at(std::string_view place, const std::string& what) const;

    const std::filesystem::path& file_;
    std::string_view text_;
    const LoadOptions& options_;
    io::NamedFiles files_;
    Budget& budget_;
    const Share share_;
    Mesh mesh_;
    Counts total_, seen_;
    std::array<float, 8> numbers_{};
    std::unordered_map<std::string_view, std::int32_t> material_of_;  ///< by its name
    Part part_;                                                       ///< what o, g and usemtl said last
    std::vector<std::string_view> libraries_;
    std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
    std::vector<std::optional<Texture>> textures_;  ///< of each entry of the material files
    std::size_t short_faces_ = 0;
    std::size_t not_finite_ = 0;
    std::size_t stray_exponents_ = 0;
};

template <class Take>
void ObjReader::each_statement(Share share, Take take) const {
    Statement statement;
    for (std::string_view rest = without_bom(text_); next_statement(rest, statement);) {
        take(statement);
        share.at(text_.size() - rest.size());
    }
}

Mesh ObjReader::read() {
    if (const std::size_t zero = text_.find('\0'); zero != text_.npos)
        fail_at(text_.substr(zero), "binary data where OBJ text should be; export the mesh again");
    mesh_.uvs.resize(1);
    each_statement(share_.part(0, counted, text_.size()), [&](const Statement& s) { total_.add(s); });
    if (total_.v == 0) fail(file_, "has no vertices (v lines); give an OBJ file that has a mesh");
    budget_.take_vertices(total_.v, kept_copies * sizeof(glm::vec3));
    budget_.take(text_.size() +
                 kept_copies * (total_.vt * sizeof(glm::vec2) + total_.vn * sizeof(glm::vec3)));
    each_statement(share_.part(counted, parsed, text_.size()), [&](const Statement& s) { take(s); });
    if (mesh_.faces.empty()) fail(file_, "has no faces (f lines of 3 corners or more); export it with faces");
    if (short_faces_ > 0)
        mesh_.warnings.push_back(std::to_string(short_faces_) + " faces have fewer than 3 corners: left out");
    if (not_finite_ > 0)
        mesh_.warnings.push_back(std::to_string(not_finite_) +
                                 " uv or color values are not finite: taken as 0");
    if (stray_exponents_ > 0)
        mesh_.warnings.push_back(std::to_string(stray_exponents_) +
                                 " numbers are written like 3.1+e2: read as 3.1, as other programs do");
    drop_unused_attributes();
    read_materials();
    return std::move(mesh_);
}

void ObjReader::take(const Statement& statement) {
    const std::string_view keyword = statement.keyword;
    if (keyword == "v") take_vertex(statement);
    if (keyword == "vn") take_normal(statement);
    if (keyword == "vt") take_uv(statement);
    if (keyword == "f") take_face(statement);
    if (keyword == "o" || keyword == "g") part_.name = trimmed(statement.arguments);
    if (keyword == "usemtl") take_material(trimmed(statement.arguments));
    if (keyword == "mtllib") libraries_.push_back(trimmed(statement.arguments));
    seen_.add(statement);
}

/// x y z, which may be followed by w (ignored), or by a color r g b, with or without alpha.
void ObjReader::take_vertex(const Statement& statement) {
    const std::size_t count = numbers(statement, 3);
    const auto& n = numbers_;
    for (std::size_t i = 0; i < 3; ++i)
        if (!std::isfinite(n[i]))
            fail_at(statement.keyword,
                    std::string("vertex ") + "xyz"[i] +
                        " is not finite (nan, infinite or beyond float); correct or remove the vertex");
    mesh_.positions.emplace_back(n[0], n[1], n[2]);
    constexpr glm::vec4 white(1.0f);
    if (count >= 6) {
        if (mesh_.colors.empty()) budget_.take(kept_copies * total_.v * sizeof(glm::vec4));
        mesh_.colors.resize(mesh_.positions.size() - 1, white);  // the vertices before that had no color
        mesh_.colors.emplace_back(finite_or_zero(n[3]), finite_or_zero(n[4]), finite_or_zero(n[5]),
                                  count >= 7 ? finite_or_zero(n[6]) : 1.0f);
    } else if (!mesh_.colors.empty()) {
        mesh_.colors.push_back(white);
    }
}

void ObjReader::take_normal(const Statement& statement) {
    numbers(statement, 3);
    const glm::vec3 normal(numbers_[0], numbers_[1], numbers_[2]);
    if (!std::isfinite(normal.x) || !std::isfinite(normal.y) || !std::isfinite(normal.z))
        fail_at(statement.keyword, "the normal is not finite; export the mesh with new normals or without");
    mesh_.normals.values.push_back(normal);
}

void ObjReader::take_uv(const Statement& statement) {
    const std::size_t count = numbers(statement, 1);
    mesh_.uvs[0].values.emplace_back(finite_or_zero(numbers_[0]),
                                     count > 1 ? finite_or_zero(numbers_[1]) : 0.0f);
}

void ObjReader::take_face(const Statement& statement) {
    const std::size_t first = mesh_.corners.size();
    std::string_view rest = statement.arguments;
    for (std::string_view token = next_argument(rest); !token.empty(); token = next_argument(rest)) {
        const auto [v, vt, vn] = corner_parts(token);
        const std::uint32_t vertex = index(v, seen_.v, total_.v, "vertex");
        if (vertex == none)
            fail_at(token,
                    "face corner " + quoted(token) + " names no vertex; write v, v/vt, v//vn or v/vt/vn");
        mesh_.corners.push_back(vertex);
        mesh_.uvs[0].corners.push_back(index(vt, seen_.vt, total_.vt, "texture coordinate"));
        mesh_.normals.corners.push_back(index(vn, seen_.vn, total_.vn, "normal"));
    }
    const std::size_t size = mesh_.corners.size() - first;
    if (size < 3) {
        ++short_faces_;
        for (auto* corners : {&mesh_.corners, &mesh_.uvs[0].corners, &mesh_.normals.corners})
            corners->resize(first);
        return;
    }
    budget_.take_faces(1, size, kept_copies * 3 * sizeof(std::uint32_t));
    begin_part();
    mesh_.faces.push_back(static_cast<std::uint32_t>(size));
    ++mesh_.parts.back().face_count;
}

void ObjReader::begin_part() {
    const auto& parts = mesh_.parts;
    if (!parts.empty() && parts.back().name == part_.name && parts.back().material == part_.material) return;
    part_.first_face = static_cast<std::uint32_t>(mesh_.faces.size());
    budget_.take(kept_copies * (sizeof(Part) + part_.name.size()));
    mesh_.parts.push_back(part_);
}

void ObjReader::take_material(std::string_view name) {
    auto& materials = mesh_.materials;
    const auto [known, is_new] = material_of_.try_emplace(name, static_cast<std::int32_t>(materials.size()));
    part_.material = known->second;
    if (!is_new) return;
    budget_.take(kept_copies * sizeof(Material) + kept_copies * name.size() + 2 * sizeof(*known));
    materials.emplace_back().name = name;
}

/// The number that assimp and tinyobjloader read where an exponent's sign stands before its letter.
std::string_view without_stray_exponent(std::string_view token) {
    for (const std::string_view sign : {"+e", "-e", "+E", "-E"}) {
        const std::size_t at = token.find(sign);
        if (at != token.npos && at > 0 && to_integer(token.substr(at + 2))) return token.substr(0, at);
    }
    return {};
}

/// Reads the statement's numbers, at most 8, into numbers_; the rest are 0. Returns how many there were.
std::size_t ObjReader::numbers(const Statement& statement, std::size_t needed) {
    numbers_.fill(0.0f);
    std::string_view rest = statement.arguments;
    std::size_t count = 0;
    for (; count < numbers_.size(); ++count) {
        const std::string_view token = next_argument(rest);
        if (token.empty()) break;
        std::optional<float> number = to_float(token);
        if (!number && (number = to_float(without_stray_exponent(token)))) ++stray_exponents_;
        if (!number) fail_at(token, quoted(token) + " is not a number; write one like -0.25 or 1e-3");
        numbers_[count] = *number;
    }
    if (count < needed)
        fail_at(statement.keyword, std::string(statement.keyword) + " has " + std::to_string(count) +
                                       " numbers and needs " + std::to_string(needed) +
                                       "; is the file cut off?");
    return count;
}

float ObjReader::finite_or_zero(float value) {
    if (std::isfinite(value)) return value;
    ++not_finite_;
    return 0.0f;
}

std::uint32_t ObjReader::index(std::string_view token, std::size_t seen, std::size_t total,
                               const char* what) const {
    if (token.empty()) return none;
    const std::optional<std::int64_t> number = to_integer(token);
    const std::string name = std::string(what) + " index " + quoted(token);
    if (!number) fail_at(token, name + " is not a whole number; export the mesh again");
    if (*number == 0) fail_at(token, name + " is out of range: OBJ counts from 1; export the mesh again");
    const std::int64_t from0 = from_zero(*number, seen);
    if (from0 < 0 || from0 >= static_cast<std::int64_t>(total))
        fail_at(token, name + " is out of range: the file has " + std::to_string(total) + " of them, " +
                           std::to_string(seen) + " before this line; export the mesh again");
    return static_cast<std::uint32_t>(from0);
}

/// vn and vt lines that no face refers to are no attributes; the writer leaves them as they are.
void ObjReader::drop_unused_attributes() {
    const auto unused = [](const auto& attribute) {
        return std::ranges::all_of(attribute.corners, [](auto index) { return index == none; });
    };
    if (unused(mesh_.normals)) mesh_.normals = {};
    if (unused(mesh_.uvs[0])) mesh_.uvs.clear();
}

std::uint64_t count_materials(std::string_view library) {
    constexpr std::string_view keyword = "newmtl";
    std::uint64_t count = 0;
    for (std::size_t at = library.find(keyword); at != library.npos; at = library.find(keyword, at + 1))
        ++count;
    return count;
}

void ObjReader::read_library(const std::filesystem::path& library, std::vector<tinyobj::material_t>& found) {
    std::istringstream text;
    try {
        std::string bytes = read_bytes(library, budget_);
        budget_.take(bytes.size() + count_materials(bytes) * sizeof(tinyobj::material_t));
        text.str(std::move(bytes));
    } catch (const OverLimit&) {
        throw;
    } catch (const Error& error) {
        mesh_.warnings.push_back(std::string("materials are left out: ") + error.what());
    }
    std::map<std::string, int> index;
    std::string warnings, errors;
    const std::size_t before = found.size();
    tinyobj::LoadMtl(&index, &found, &text, &warnings, &errors);
    warn_of_textures(library, std::span(found).subspan(before));
    find_textures(library, std::span(found).subspan(before));
}

/// Replaces the backslashes that paths have on Windows.
std::string with_slashes(std::string name) {
    std::ranges::replace(name, '\\', '/');
    return name;
}

/// Kd is no factor: exporters write all kinds of gray beside a map, and programs that show it leave Kd out.
Texture texture_with(const tinyobj::texture_option_t& option, std::shared_ptr<const Image> image) {
    Texture texture{.image = std::move(image)};
    texture.transform =
        glm::mat3x2(option.scale[0], 0, 0, option.scale[1], option.origin_offset[0], option.origin_offset[1]);
    if (option.clamp) texture.wrap_u = texture.wrap_v = Wrap::clamp;
    return texture;
}

/// Finds the images of map_Kd that are there and may be read, each once.
void ObjReader::find_textures(const std::filesystem::path& library,
                              std::span<const tinyobj::material_t> materials) {
    const io::NamedFiles files(library, options_.allow_outside);
    std::set<std::string> outside;
    for (const tinyobj::material_t& material : materials) {
        const std::string name = with_slashes(material.diffuse_texname);
        std::error_code error;
        const auto place = name.empty() ? std::nullopt : files.find(name);
        if (!name.empty() && !place && outside.insert(name).second)
            mesh_.warnings.push_back("a texture is not looked at: " + io::about(library, "names ") +
                                     mesh::quoted(name) + io::NamedFiles::outside);
        if (place && images_.find(*place) == images_.end() && std::filesystem::is_regular_file(*place, error))
            images_.emplace(*place, image_in(*place, options_.limits));
        const auto image = place ? images_.find(*place) : images_.end();
        textures_.push_back(image == images_.end()
                                ? std::nullopt
                                : std::optional(texture_with(material.diffuse_texopt, image->second)));
    }
}

/// Most of them nothing reads, but whoever shows the output wants them. Those outside are not even looked
/// for.
void ObjReader::warn_of_textures(const std::filesystem::path& library,
                                 std::span<const tinyobj::material_t> materials) {
    const io::NamedFiles files(library, false);
    std::set<std::string> missing;
    for (const tinyobj::material_t& material : materials) {
        for (const auto texture :
             {&tinyobj::material_t::diffuse_texname, &tinyobj::material_t::ambient_texname,
              &tinyobj::material_t::specular_texname, &tinyobj::material_t::specular_highlight_texname,
              &tinyobj::material_t::bump_texname, &tinyobj::material_t::displacement_texname,
              &tinyobj::material_t::alpha_texname, &tinyobj::material_t::reflection_texname,
              &tinyobj::material_t::roughness_texname, &tinyobj::material_t::metallic_texname,
              &tinyobj::material_t::emissive_texname, &tinyobj::material_t::normal_texname}) {
            const std::string name = with_slashes(material.*texture);
            std::error_code error;
            const auto place = files.find(name);
            if (!name.empty() && place && !std::filesystem::is_regular_file(*place, error))
                missing.insert(name);
        }
    }
    for (const std::string& name : missing)
        mesh_.warnings.push_back("a texture is missing: " + io::about(library, "names ") +
                                 mesh::quoted(name) +
                                 ", which is not there; put it beside the material file");
}

/// Reads the material files, each once. The file's name is looked up for each, which takes far longer than to
/// read the line that names it: hence the limit.
std::vector<tinyobj::material_t> ObjReader::read_libraries() {
    constexpr std::size_t most = 1000;
    std::vector<tinyobj::material_t> found;
    std::set<std::string_view> lines;
    std::set<std::filesystem::path> read;
    for (const std::string_view line : libraries_) {
        if (!lines.insert(line).second) continue;
        for (const std::string_view name : library_names(file_, line)) {
            if (read.size() >= most || lines.size() > most) {
                mesh_.warnings.push_back("materials are left out: there are more than " +
                                         std::to_string(most) + " material files; merge them");
                return found;
            }
            const std::optional<std::filesystem::path> library = files_.find(name);
            if (!library) {
                mesh_.warnings.push_back("materials are left out: " + line_of(text_, name.data()) +
                                         ": mtllib names " + quoted(name) + io::NamedFiles::outside);
            } else if (read.insert(*library).second) {
                read_library(*library, found);
            }
        }
    }
    return found;
}

void ObjReader::read_materials() {
    const std::vector<tinyobj::material_t> found = read_libraries();
    std::vector<bool> colored(mesh_.materials.size(), false);  // the first entry of a name counts
    for (std::size_t i = 0; i < found.size(); ++i) {
        const tinyobj::material_t& entry = found[i];
        const auto used = material_of_.find(trimmed(entry.name));
        if (used == material_of_.end()) continue;
        const auto number = static_cast<std::size_t>(used->second);
        if (colored[number]) continue;
        colored[number] = true;
        const float rgba[] = {entry.diffuse[0], entry.diffuse[1], entry.diffuse[2], entry.dissolve};
        for (int c = 0; c < 4; ++c) mesh_.materials[number].base_color[c] = std::clamp(rgba[c], 0.0f, 1.0f);
        mesh_.materials[number].texture = textures_[i];
    }
}

void ObjReader::fail_at(std::string_view place, const std::string& what) const {
    fail(file_, line_of(text_, place.data()) + ": " + what);
}

}  // namespace

bool next_statement(std::string_view& rest, Statement& out) {
    if (rest.empty()) return false;
    const char* const begin = rest.data();
    std::string_view line = next_line(rest);
    const bool comment = trimmed(line).starts_with('#');
    while (!comment && line.ends_with('\\') && !rest.empty()) {
        const std::string_view more = next_line(rest);
        line = {begin, static_cast<std::size_t>(more.data() + more.size() - begin)};
    }
    out.end = line.substr(line.size());
    out.windows = rest.data() - out.end.data() == 2;
    out.arguments = line;
    out.keyword = comment ? std::string_view() : next_token(out.arguments);
    return true;
}

std::string_view next_argument(std::string_view& rest) {
    const std::string_view token = next_token(rest);
    if (!token.starts_with('#')) return token;
    rest = {};
    return {};
}

void Counts::add(const Statement& statement) {
    v += statement.keyword == "v";
    vt += statement.keyword == "vt";
    vn += statement.keyword == "vn";
}

std::vector<std::string_view> library_names(const std::filesystem::path& obj, std::string_view arguments) {
    arguments = trimmed(arguments);
    std::error_code error;
    if (std::filesystem::is_regular_file(obj.parent_path() / arguments, error)) return {arguments};
    std::vector<std::string_view> names;
    for (std::string_view name = next_token(arguments); !name.empty(); name = next_token(arguments))
        names.push_back(name);
    return names;
}

std::array<std::string_view, 3> corner_parts(std::string_view argument) {
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? std::min(argument.find('/'), argument.size()) : argument.size();
        parts[i] = argument.substr(0, end);
        argument.remove_prefix(std::min(end + 1, argument.size()));
    }
    return parts;
}

Mesh read_obj(const std::filesystem::path& file, std::string_view bytes, const LoadOptions& options,
              Budget& budget, const Share& share) {
    Mesh mesh = ObjReader(file, bytes, options, budget, share).read();
    auto source = std::make_shared<ObjSource>();
    source->file = file;
    source->options = options;
    source->options.progress = {};  // whom it tells may be gone when the source is used
    source->text = bytes;
    source->read = mesh;
    mesh.source = std::move(source);
    return mesh;
}

}  // namespace goffer::mesh
