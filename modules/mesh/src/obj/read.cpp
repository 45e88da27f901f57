// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "format.hpp"
#include "materials.hpp"
#include "obj.hpp"

#include <goffer/io/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace goffer::mesh {
namespace {

constexpr double counted = 0.2, parsed = 0.9;  ///< shares of the time by when the two passes are over

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, std::string_view text, const LoadOptions& options,
              Budget& budget, const Share& share)
        : file_(file), text_(text), options_(options), budget_(budget), share_(share) {}
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
    [[noreturn]] void fail_at(std::string_view place, const std::string& what) const;

    const std::filesystem::path& file_;
    std::string_view text_;
    const LoadOptions& options_;
    Budget& budget_;
    const Share share_;
    Mesh mesh_;
    Counts total_, seen_;
    std::array<float, 8> numbers_{};
    MaterialLines materials_;
    Part part_;  ///< what o, g and usemtl said last
    std::size_t short_faces_ = 0;
    std::size_t not_finite_ = 0;
    std::size_t stray_exponents_ = 0;
};

template <class Take>
void ObjReader::each_statement(Share share, Take take) const {
    Statement statement;
    for (std::string_view rest = io::without_bom(text_); next_statement(rest, statement);) {
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
    if (short_faces_ > 0) mesh_.warnings.push_back(short_faces_warning(short_faces_));
    if (not_finite_ > 0) mesh_.warnings.push_back(not_finite_warning(not_finite_));
    if (stray_exponents_ > 0)
        mesh_.warnings.push_back(number_of(stray_exponents_, "number is", "numbers are") +
                                 " written like 3.1+e2: read as 3.1, as other programs do");
    drop_unused_attributes();
    read_materials(file_, text_, materials_, options_, budget_, mesh_);
    return std::move(mesh_);
}

void ObjReader::take(const Statement& statement) {
    const std::string_view keyword = statement.keyword;
    if (keyword == "v") take_vertex(statement);
    if (keyword == "vn") take_normal(statement);
    if (keyword == "vt") take_uv(statement);
    if (keyword == "f") take_face(statement);
    if (keyword == "o" || keyword == "g") part_.name = io::trimmed(statement.arguments);
    if (keyword == "usemtl") take_material(io::trimmed(statement.arguments));
    if (keyword == "mtllib") materials_.libraries.push_back(io::trimmed(statement.arguments));
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
    const auto [known, is_new] =
        materials_.used.try_emplace(name, static_cast<std::int32_t>(materials.size()));
    part_.material = known->second;
    if (!is_new) return;
    budget_.take(kept_copies * sizeof(Material) + kept_copies * name.size() + 2 * sizeof(*known));
    materials.emplace_back().name = name;
}

/// The number that assimp and tinyobjloader read where an exponent's sign stands before its letter.
std::string_view without_stray_exponent(std::string_view token) {
    for (const std::string_view sign : {"+e", "-e", "+E", "-E"}) {
        const std::size_t at = token.find(sign);
        if (at != token.npos && at > 0 && io::to_integer(token.substr(at + 2))) return token.substr(0, at);
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
        std::optional<float> number = io::to_float(token);
        if (!number && (number = io::to_float(without_stray_exponent(token)))) ++stray_exponents_;
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
    const std::optional<std::int64_t> number = io::to_integer(token);
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

void ObjReader::fail_at(std::string_view place, const std::string& what) const {
    fail(file_, line_of(text_, place.data()) + ": " + what);
}

}  // namespace

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

std::vector<std::filesystem::path> obj_files(const std::filesystem::path& file, std::string_view bytes,
                                             const LoadOptions& options, Budget& budget) {
    MaterialLines lines;
    Statement statement;
    for (std::string_view rest = io::without_bom(bytes); next_statement(rest, statement);)
        if (statement.keyword == "mtllib") lines.libraries.push_back(io::trimmed(statement.arguments));
    return material_files(file, bytes, lines, options, budget);
}

}  // namespace goffer::mesh
