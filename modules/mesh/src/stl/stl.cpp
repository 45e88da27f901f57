// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "face_cutter.hpp"
#include "format.hpp"
#include "refine.hpp"
#include "text.hpp"

#include <goffer/io/bytes.hpp>
#include <goffer/io/text.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

// No library is used: a facet is 50 bytes, and importers drop the header and the attribute bytes, which have
// to be given back. The normal of a facet follows from its corners and belongs to no vertex. So it is not an
// attribute of the mesh: it stays with the source, and is computed again if the facet moves.

namespace goffer::mesh {
namespace {

using io::append_bytes;
using io::from_bytes;

constexpr std::size_t header_size = 84, facet_size = 50;

struct StlSource final : Source {
    std::string bytes;
    Mesh read;
};

std::uint64_t declared_size(std::string_view bytes) {
    return header_size + facet_size * std::uint64_t{from_bytes<std::uint32_t>(bytes.substr(80))};
}

/// A binary file says how many facets follow its header. If that fits its size it is binary, even if it
/// begins with "solid".
bool is_binary(std::string_view bytes) {
    return bytes.size() >= header_size + facet_size && bytes.size() == declared_size(bytes);
}

bool says_solid(std::string_view bytes) {
    bytes = io::without_bom(bytes);
    return lower(next_token(bytes)) == "solid";
}

bool is_text(std::string_view bytes) {
    return says_solid(bytes) && !is_binary(bytes) && bytes.find('\0') == bytes.npos;
}

/// The facets of an ASCII file, one after another.
class TextFacets {
public:
    TextFacets(const std::filesystem::path& file, std::string_view text)
        : file_(file), text_(text), rest_(io::without_bom(text)) {}

    /// Finds the next facet; false at the end.
    bool next();

    [[nodiscard]] std::string_view normal(std::size_t axis) const { return numbers_[axis]; }
    [[nodiscard]] std::string_view vertex(std::size_t corner, std::size_t axis) const {
        return numbers_[3 + 3 * corner + axis];
    }
    [[nodiscard]] std::string_view solid() const { return solid_; }
    [[nodiscard]] std::size_t solids() const { return solids_; }
    [[nodiscard]] std::string_view end() const { return rest_.substr(0, 0); }  ///< of the facet
    [[noreturn]] void fail_at(std::string_view place, const std::string& what) const {
        fail(file_, line_of(text_, place.data()) + ": " + what);
    }

private:
    void expect(std::string_view word);
    void take_numbers(std::size_t first);

    const std::filesystem::path& file_;
    std::string_view text_, rest_, solid_;
    std::size_t solids_ = 0;
    bool inside_ = false;
    std::array<std::string_view, 12> numbers_;  ///< the normal's, then the vertices'
};

bool TextFacets::next() {
    while (true) {
        const std::string_view token = next_token(rest_);
        const std::string word = lower(token);
        if (word.empty() && !inside_) return false;
        if (word == "facet" && inside_) break;
        const bool fits = inside_ ? word == "endsolid" : word == "solid";
        if (!fits)
            fail_at(token, (word.empty() ? "the file ends" : quoted(token) + " stands") +
                               std::string(inside_ ? " where facet or endsolid" : " where solid") +
                               " should be; is the file cut off?");
        const std::string_view name = io::trimmed(next_line(rest_));
        inside_ = !inside_;
        if (!inside_) continue;
        solid_ = name;
        ++solids_;
    }
    expect("normal");
    take_numbers(0);
    expect("outer");
    expect("loop");
    for (std::size_t corner = 0; corner < 3; ++corner) {
        expect("vertex");
        take_numbers(3 + 3 * corner);
    }
    expect("endloop");
    expect("endfacet");
    return true;
}

void TextFacets::expect(std::string_view word) {
    const std::string_view token = next_token(rest_);
    if (lower(token) == word) return;
    fail_at(token, (token.empty() ? "the file ends" : quoted(token) + " stands") + " where " +
                       std::string(word) + " should be; a facet is a normal and a loop of 3 vertices");
}

void TextFacets::take_numbers(std::size_t first) {
    for (std::size_t axis = 0; axis < 3; ++axis) numbers_[first + axis] = next_token(rest_);
}

void take_facets(Budget& budget, std::uint64_t count) {
    budget.take_vertices(3 * count, kept_copies * sizeof(glm::vec3));
    budget.take_faces(count, 3 * count, kept_copies * sizeof(std::uint32_t));
}

void add_vertex(Mesh& mesh, const glm::vec3& position) {
    mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(position);
}

float coordinate(const TextFacets& facets, std::string_view token) {
    const std::optional<float> number = io::to_float(token);
    if (!number) facets.fail_at(token, quoted(token) + " is not a number; write one like -0.25 or 1e-3");
    if (!std::isfinite(*number))
        facets.fail_at(token, "vertex coordinate " + quoted(token) + " is not finite; remove the facet");
    return *number;
}

Mesh read_text(const std::filesystem::path& file, std::string_view text, Budget& budget, Share share) {
    Mesh mesh;
    for (TextFacets facets(file, text); facets.next();) {
        take_facets(budget, 1);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            glm::vec3 position;
            for (int axis = 0; axis < 3; ++axis)
                position[axis] = coordinate(facets, facets.vertex(corner, static_cast<std::size_t>(axis)));
            add_vertex(mesh, position);
        }
        if (facets.solids() > mesh.parts.size()) {
            budget.take(kept_copies * (facets.solids() - mesh.parts.size()) * sizeof(Part));
            const auto first = static_cast<std::uint32_t>(mesh.faces.size());
            mesh.parts.resize(facets.solids() - 1,
                              {.name = {}, .first_face = first});  // solids without facets
            mesh.parts.push_back({.name = std::string(facets.solid()), .first_face = first});
        }
        mesh.faces.push_back(3);
        ++mesh.parts.back().face_count;
        share.at(static_cast<std::uint64_t>(facets.end().data() - text.data()));
    }
    return mesh;
}

Mesh read_binary(const std::filesystem::path& file, std::string_view bytes, Budget& budget, Share share) {
    if (bytes.size() < header_size)
        fail(file, "has " + std::to_string(bytes.size()) +
                       " bytes, and an STL file has 84 or more; is it cut off, or not an STL file?");
    const std::size_t facets = from_bytes<std::uint32_t>(bytes.substr(80));
    if (declared_size(bytes) > bytes.size())
        fail(file, "byte 80 says " + std::to_string(facets) + " facets, but there are bytes for " +
                       std::to_string((bytes.size() - header_size) / facet_size) +
                       "; is the file cut off, or not an STL file?");
    take_facets(budget, facets);
    Mesh mesh;
    for (std::size_t f = 0; f < facets; ++f) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::string_view at = bytes.substr(header_size + facet_size * f + 12 * (corner + 1));
            glm::vec3 position;
            for (int axis = 0; axis < 3; ++axis) {
                position[axis] = from_bytes<float>(at.substr(4 * static_cast<std::size_t>(axis)));
                if (!std::isfinite(position[axis]))
                    fail(file, "facet " + std::to_string(f) +
                                   " (counted from 0): a vertex coordinate is not finite; "
                                   "remove the facet");
            }
            add_vertex(mesh, position);
        }
        share.at(facet_size * (f + 1));
    }
    mesh.faces.assign(facets, 3);
    mesh.parts.push_back({.name = {}, .face_count = static_cast<std::uint32_t>(facets)});
    if (declared_size(bytes) < bytes.size())
        mesh.warnings.push_back(number_of(bytes.size() - declared_size(bytes), "byte", "bytes") +
                                " behind the last facet: not read");
    return mesh;
}

/// The normal at unit length; zero for a facet without area.
glm::vec3 facet_normal(const std::array<glm::vec3, 3>& p) {
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
    const double length = glm::length(normal);
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
}

std::array<glm::vec3, 3> facet(const Mesh& mesh, std::size_t f) {
    return {mesh.positions[3 * f], mesh.positions[3 * f + 1], mesh.positions[3 * f + 2]};
}

void append_facet(std::string& out, const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 normal = facet_normal(corners);
    for (const glm::vec3& v : {normal, corners[0], corners[1], corners[2]})
        append_bytes(out, std::endian::little, v.x, v.y, v.z);
}

std::string edit_text(const StlSource& source, const Mesh& mesh) {
    const std::filesystem::path nowhere;  // for messages; there are none, since the text was read before
    Editor out(source.bytes);
    TextFacets facets(nowhere, source.bytes);
    for (std::size_t f = 0; facets.next(); ++f) {
        const auto corners = facet(mesh, f);
        if (corners == facet(source.read, f)) continue;
        const glm::vec3 normal = facet_normal(corners);
        for (std::size_t axis = 0; axis < 3; ++axis)
            out.replace(facets.normal(axis), normal[static_cast<int>(axis)]);
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                out.replace(facets.vertex(corner, axis), corners[corner][static_cast<int>(axis)]);
    }
    return out.finish();
}

std::string edit_binary(const StlSource& source, const Mesh& mesh) {
    std::string out = source.bytes;
    std::string moved;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto corners = facet(mesh, f);
        if (corners == facet(source.read, f)) continue;
        moved.clear();
        append_facet(moved, corners);
        out.replace(header_size + facet_size * f, moved.size(), moved);
    }
    return out;
}

void append_text(std::string& out, const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 normal = facet_normal(corners);
    out += "\n  facet normal";
    append_all(out, normal.x, normal.y, normal.z);
    out += "\n    outer loop";
    for (const glm::vec3& v : corners) {
        out += "\n      vertex";
        append_all(out, v.x, v.y, v.z);
    }
    out += "\n    endloop\n  endfacet";
}

/// The corners of a piece, in a mesh whose faces are all triangles.
std::array<glm::vec3, 3> piece(const Mesh& refined, std::size_t p) {
    const auto at = [&](std::size_t k) { return refined.positions[refined.corners[3 * p + k]]; };
    return {at(0), at(1), at(2)};
}

std::string refine_text(const std::string& text, const Cut& cut, const Mesh& refined, Share share) {
    const std::filesystem::path nowhere;  // as in edit_text
    Editor out(text);
    TextFacets facets(nowhere, text);
    for (std::size_t f = 0; facets.next(); ++f) {
        share.at(f);
        if (!cut.is_cut(f)) continue;
        const auto first = piece(refined, cut.first_piece(f));
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                out.replace(facets.vertex(corner, axis), first[corner][static_cast<int>(axis)]);
        std::string others;
        for (std::size_t p = cut.first_piece(f) + 1; p < cut.first_piece(f + 1); ++p)
            append_text(others, piece(refined, p));
        out.replace(facets.end(), others);
    }
    return out.finish();
}

std::string refine_binary(const std::string& bytes, const Cut& cut, const Mesh& refined, Share share) {
    std::string out = bytes.substr(0, header_size - 4);
    append_bytes(out, std::endian::little, static_cast<std::uint32_t>(refined.faces.size()));
    for (std::size_t f = 0; f < cut.mesh().faces.size(); ++f) {
        share.at(f);
        const std::string facet = bytes.substr(header_size + facet_size * f, facet_size);
        if (!cut.is_cut(f)) out += facet;
        for (std::size_t p = cut.first_piece(f); cut.is_cut(f) && p < cut.first_piece(f + 1); ++p) {
            append_facet(out, piece(refined, p));
            out += facet.substr(facet_size - 2);  // its attributes
        }
    }
    return out;
}

std::string write_anew(const Mesh& mesh) {
    std::string out = "goffer";
    out.resize(80);
    append_bytes(out, std::endian::little, static_cast<std::uint32_t>(triangle_count(mesh)));
    FaceCutter cut(mesh);
    std::size_t first = 0;
    for (const std::uint32_t size : mesh.faces) {
        const auto own = cut(first, size);
        const auto place = [&](std::size_t k) { return mesh.positions[mesh.corners[own[k]]]; };
        for (std::size_t k = 0; k < own.size(); k += 3) {
            append_facet(out, {place(k), place(k + 1), place(k + 2)});
            out.append(2, '\0');  // no attributes
        }
        first += size;
    }
    return out;
}

}  // namespace

bool is_stl(std::string_view bytes) {
    if (is_binary(bytes)) return true;
    if (!is_text(bytes)) return false;
    bytes = io::without_bom(bytes);
    next_token(bytes);
    next_line(bytes);
    const std::string word = lower(next_token(bytes));
    return word == "facet" || word == "endsolid";
}

Mesh read_stl(const std::filesystem::path& file, std::string_view bytes, Budget& budget, const Share& share) {
    budget.take(bytes.size());
    const Share parsing = share.part(0, 0.85, bytes.size());  // then the source is put together
    Mesh mesh =
        is_text(bytes) ? read_text(file, bytes, budget, parsing) : read_binary(file, bytes, budget, parsing);
    if (mesh.faces.empty()) fail(file, "has no facets; export the mesh again");
    auto source = std::make_shared<StlSource>();
    source->bytes = bytes;
    source->read = mesh;
    mesh.source = std::move(source);
    return mesh;
}

std::optional<Mesh> refined_stl(const Cut& cut, const Mesh& alone, const Share& share) {
    const auto* source = dynamic_cast<const StlSource*>(cut.mesh().source.get());
    if (!source || !only_bent(cut.mesh(), source->read)) return std::nullopt;
    const std::string now = write_stl(cut.mesh());
    const Share writing = share.part(0.2, 0.6, cut.mesh().faces.size());
    const std::string bytes =
        is_text(now) ? refine_text(now, cut, alone, writing) : refine_binary(now, cut, alone, writing);
    Budget budget;
    Mesh out = read_stl({}, bytes, budget, share.part(0.6, 1));
    out.warnings = cut.mesh().warnings;
    return out;
}

std::string write_stl(const Mesh& mesh) {
    const auto* source = dynamic_cast<const StlSource*>(mesh.source.get());
    if (!source || !only_bent(mesh, source->read)) return write_anew(mesh);
    return is_text(source->bytes) ? edit_text(*source, mesh) : edit_binary(*source, mesh);
}

}  // namespace goffer::mesh
