// SPDX-License-Identifier: MIT
#include "color.hpp"
#include "format.hpp"
#include "ply.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::mesh {
namespace {

using namespace ply;
constexpr std::endian order = std::endian::little;  ///< of new files

/// Edits the file that a mesh came from: puts in new positions and normals, in the file's own format and
/// types. Values that did not change stay as they are, to the byte. Integer coordinates, which could not hold
/// the new values, become floats.
class PlyEditor {
public:
    PlyEditor(const PlySource& source, const Mesh& mesh)
        : header_(read_header({}, source.bytes)), mesh_(mesh), was_(source.read), out_(source.bytes) {
        for (const Element& element : header_.elements)
            for (const Property& property : element.properties)
                if (widens(property)) out_.replace(property.type_word, "float");
        walk(header_, *this);
    }
    std::string finish() { return out_.finish(); }

    void value(const Cursor&, const Property& property, const Value& value) {
        if (property.role > Role::nz || (is_normal(property.role) && mesh_.normals.empty())) return;
        const float now = coordinate(mesh_, property.role);
        if (now == coordinate(was_, property.role) && !widens(property)) return;
        std::string bytes;
        if (header_.text)
            append(bytes, now);
        else if (property.type == Type::f64)
            append_bytes(bytes, header_.order, double{now});
        else
            append_bytes(bytes, header_.order, now);
        out_.replace(value.bytes, bytes);
    }
    void end_row(const Cursor&, const Element& element) { vertex_ += element.name == "vertex"; }
    void end(const Cursor&) {}

private:
    static bool is_normal(Role role) { return role >= Role::nx && role <= Role::nz; }

    bool widens(const Property& property) const {
        if (property.role > Role::nz || !is_integer(property.type)) return false;
        return is_normal(property.role) ? mesh_.normals != was_.normals : mesh_.positions != was_.positions;
    }

    float coordinate(const Mesh& mesh, Role role) const {
        const int axis = static_cast<int>(role) % 3;
        return is_normal(role) ? mesh.normals.values[vertex_][axis] : mesh.positions[vertex_][axis];
    }

    const Header header_;
    const Mesh& mesh_;
    const Mesh& was_;
    Editor out_;
    std::size_t vertex_ = 0;
};

/// One normal per vertex, as PLY has them: the mean of those at the vertex's corners.
std::vector<glm::vec3> vertex_normals(const Mesh& mesh) {
    if (mesh.normals.per_vertex()) return mesh.normals.values;
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t c = 0; c < mesh.corners.size(); ++c)
        if (const std::uint32_t i = mesh.normals.corners[c]; i != none)
            sums[mesh.corners[c]] += mesh.normals.values[i];
    std::vector<glm::vec3> out;
    for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        out.emplace_back(length > 0 ? sum / length : glm::dvec3(0.0));
    }
    return out;
}

/// Whether all colors are values of bytes, and can be written as such.
bool are_bytes(const std::vector<glm::vec4>& colors) {
    const auto is_byte = [](float c) {
        return c >= 0 && c <= 1 && static_cast<float>(std::round(c * 255.0) / 255.0) == c;
    };
    return std::ranges::all_of(colors, [&](const glm::vec4& c) {
        return is_byte(c.r) && is_byte(c.g) && is_byte(c.b) && is_byte(c.a);
    });
}

class PlyWriter {
public:
    explicit PlyWriter(const Mesh& mesh)
        : mesh_(mesh),
          normals_(vertex_normals(mesh)),
          colors_(mesh.colors),
          vertex_uvs_(!mesh.uvs.empty() && mesh.uvs[0].per_vertex()),
          face_uvs_(!mesh.uvs.empty() && !mesh.uvs[0].per_vertex()),
          // A texcoord list has two numbers for each corner, and a byte counts to 255.
          byte_counts_(*std::ranges::max_element(mesh.faces) <= 127) {
        for (glm::vec4& color : colors_) color = color_as(false, mesh, color);
        byte_colors_ = are_bytes(colors_);
    }

    std::string write() {
        add_header();
        for (std::size_t v = 0; v < mesh_.positions.size(); ++v) add_vertex(v);
        std::size_t first = 0;
        for (const std::uint32_t size : mesh_.faces) {
            add_face(first, size);
            first += size;
        }
        return std::move(out_);
    }

private:
    void add_header() {
        const std::string count_type = byte_counts_ ? "uchar" : "uint";
        out_ = "ply\nformat binary_little_endian 1.0\n";
        out_ += "element vertex " + std::to_string(mesh_.positions.size()) + '\n';
        add_properties("float", {"x", "y", "z"});
        if (!normals_.empty()) add_properties("float", {"nx", "ny", "nz"});
        if (vertex_uvs_) add_properties("float", {"s", "t"});
        if (!colors_.empty())
            add_properties(byte_colors_ ? "uchar" : "float", {"red", "green", "blue", "alpha"});
        out_ += "element face " + std::to_string(mesh_.faces.size()) + '\n';
        out_ += "property list " + count_type + " int vertex_indices\n";
        if (face_uvs_) out_ += "property list " + count_type + " float texcoord\n";
        out_ += "end_header\n";
    }

    void add_properties(const std::string& type, std::initializer_list<const char*> names) {
        for (const char* name : names) out_ += "property " + type + ' ' + name + '\n';
    }

    void add_vertex(std::size_t v) {
        const glm::vec3& p = mesh_.positions[v];
        append_bytes(out_, order, p.x, p.y, p.z);
        if (!normals_.empty()) append_bytes(out_, order, normals_[v].x, normals_[v].y, normals_[v].z);
        if (vertex_uvs_) append_bytes(out_, order, mesh_.uvs[0].values[v].x, mesh_.uvs[0].values[v].y);
        if (colors_.empty()) return;
        for (int i = 0; i < 4; ++i) {
            const float channel = colors_[v][i];
            if (byte_colors_)
                append_bytes(out_, order, static_cast<std::uint8_t>(std::lround(channel * 255.0)));
            else
                append_bytes(out_, order, channel);
        }
    }

    void add_count(std::size_t count) {
        if (byte_counts_)
            append_bytes(out_, order, static_cast<std::uint8_t>(count));
        else
            append_bytes(out_, order, static_cast<std::uint32_t>(count));
    }

    void add_face(std::size_t first, std::size_t size) {
        add_count(size);
        for (std::size_t c = first; c < first + size; ++c) append_bytes(out_, order, mesh_.corners[c]);
        if (!face_uvs_) return;
        const auto& [values, corners] = mesh_.uvs[0];
        const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(size);
        const bool complete = std::find(begin, end, none) == end;
        add_count(complete ? 2 * size : 0);
        for (auto uv = begin; complete && uv != end; ++uv)
            append_bytes(out_, order, values[*uv].x, values[*uv].y);
    }

    const Mesh& mesh_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec4> colors_;
    bool byte_colors_ = false, vertex_uvs_, face_uvs_, byte_counts_;
    std::string out_;
};

}  // namespace

std::string write_ply(const Mesh& mesh) {
    const auto* source = dynamic_cast<const PlySource*>(mesh.source.get());
    if (source && only_bent(mesh, source->read)) return PlyEditor(*source, mesh).finish();
    return PlyWriter(mesh).write();
}

}  // namespace goffer::mesh
