// SPDX-License-Identifier: MIT
#include "budget.hpp"
#include "format.hpp"
#include "ply.hpp"

#include <goffer/io/text.hpp>

#include <array>
#include <cmath>

namespace goffer::mesh {
namespace {

using namespace ply;
constexpr double all_parsed = 0.85;  ///< the share of the time after which the source is put together

class PlyReader {
public:
    PlyReader(const Header& header, Budget& budget, const Share& share);
    Mesh read();

    void value(const Cursor& cursor, const Property& property, const Value& value);
    void end_row(const Cursor& cursor, const Element& element);
    void end(const Cursor& cursor);

private:
    [[nodiscard]] bool has(Role role) const { return vertex_->find(role) != nullptr; }
    [[nodiscard]] float at(Role role) const {
        return static_cast<float>(row_[static_cast<std::size_t>(role)]);
    }
    float color(Role role);
    void end_vertex(const Cursor& cursor);
    void end_face();
    float finite_or_zero(double value);

    const Header& header_;
    Budget& budget_;
    Share share_;  ///< in bytes
    const Element* vertex_;
    Mesh mesh_;
    bool has_normals_ = false, has_colors_ = false, has_uvs_ = false, has_texcoords_ = false;
    std::array<double, vertex_roles> row_{};
    std::vector<std::uint32_t> indices_;
    std::vector<float> texcoords_;
    std::size_t short_faces_ = 0, not_finite_ = 0;
};

PlyReader::PlyReader(const Header& header, Budget& budget, const Share& share)
    : header_(header), budget_(budget), share_(share), vertex_(header.find("vertex")) {
    if (!vertex_) fail(header.file, "the header has no element vertex; give a PLY file that has a mesh");
    for (const Role role : {Role::x, Role::y, Role::z})
        if (!has(role))
            fail(header.file, std::string("element vertex has no property ") + "xyz"[static_cast<int>(role)] +
                                  "; export the mesh again");
    const Element* face = header.find("face");
    if (!face || !face->find(Role::indices))
        fail(header.file,
             "there are no faces: no element face with a list vertex_indices; export it with faces" +
                 std::string(header.find("tristrips") ? " (triangle strips are not read)" : ""));
    has_normals_ = has(Role::nx) && has(Role::ny) && has(Role::nz);
    has_colors_ = has(Role::red) && has(Role::green) && has(Role::blue);
    has_texcoords_ = face->find(Role::texcoord) != nullptr;
    has_uvs_ = !has_texcoords_ && has(Role::u) && has(Role::v);
    if (has_texcoords_ || has_uvs_) mesh_.uvs.resize(1);
    budget_.take(header.bytes.size());
}

Mesh PlyReader::read() {
    mesh_.warnings = header_.warnings;
    walk(header_, *this);
    if (mesh_.faces.empty())
        fail(header_.file, "there are no faces of 3 corners or more; export it with faces");
    mesh_.parts.push_back({.name = {}, .face_count = static_cast<std::uint32_t>(mesh_.faces.size())});
    if (has_texcoords_ && mesh_.uvs[0].values.empty()) mesh_.uvs.clear();
    if (short_faces_ > 0) mesh_.warnings.push_back(short_faces_warning(short_faces_));
    if (not_finite_ > 0) mesh_.warnings.push_back(not_finite_warning(not_finite_));
    return std::move(mesh_);
}

void PlyReader::value(const Cursor& cursor, const Property& property, const Value& value) {
    const Role role = property.role;
    if (role < Role::other) row_[static_cast<std::size_t>(role)] = value.number;
    if (role == Role::texcoord) texcoords_.push_back(finite_or_zero(value.number));
    if (role != Role::indices) return;
    // More vertices than 32 bits number are refused where they are read, which may be after the faces.
    constexpr double most = std::numeric_limits<std::uint32_t>::max();
    const bool in_range =
        value.number >= 0 && value.number < std::min(static_cast<double>(vertex_->count), most);
    if (!in_range || value.number != std::floor(value.number)) {
        std::string index;
        append(index, value.number);
        cursor.fail_here("vertex index " + index + " is out of range: there are " +
                         std::to_string(vertex_->count) + " vertices, counted from 0; export the mesh again");
    }
    indices_.push_back(static_cast<std::uint32_t>(value.number));
}

void PlyReader::end_row(const Cursor& cursor, const Element& element) {
    if (&element == vertex_) end_vertex(cursor);
    if (element.name == "face") end_face();
    share_.at(header_.bytes.size() - cursor.rest().size());
}

void PlyReader::end(const Cursor& cursor) {
    if (const std::string_view rest = io::trimmed(cursor.rest()); !rest.empty())
        mesh_.warnings.push_back(number_of(rest.size(), "byte", "bytes") +
                                 " behind the last element: not read");
}

void PlyReader::end_vertex(const Cursor& cursor) {
    for (const Role role : {Role::x, Role::y, Role::z, Role::nx, Role::ny, Role::nz})
        if (has_normals_ || role <= Role::z)
            if (!std::isfinite(at(role)))
                cursor.fail_here(quoted(vertex_->find(role)->name) +
                                 " is not finite (nan, infinite or beyond float); "
                                 "correct or remove the vertex");
    budget_.take_vertices(
        1, kept_copies * (sizeof(glm::vec3) * (has_normals_ ? 2 : 1) + (has_colors_ ? sizeof(glm::vec4) : 0) +
                          (has_uvs_ ? sizeof(glm::vec2) : 0)));
    mesh_.positions.emplace_back(at(Role::x), at(Role::y), at(Role::z));
    if (has_normals_) mesh_.normals.values.emplace_back(at(Role::nx), at(Role::ny), at(Role::nz));
    if (has_colors_)
        mesh_.colors.emplace_back(color(Role::red), color(Role::green), color(Role::blue),
                                  has(Role::alpha) ? color(Role::alpha) : 1.0f);
    if (has_uvs_)
        mesh_.uvs[0].values.emplace_back(finite_or_zero(row_[static_cast<std::size_t>(Role::u)]),
                                         finite_or_zero(row_[static_cast<std::size_t>(Role::v)]));
}

/// A texcoord list has two numbers for each corner; that of a face may be empty.
void PlyReader::end_face() {
    const std::size_t size = indices_.size();
    if (size >= 3) {
        constexpr std::uint64_t index = sizeof(std::uint32_t), uv = sizeof(glm::vec2);
        budget_.take_faces(1, size, kept_copies * (has_texcoords_ ? 2 * index + uv : index));
        mesh_.faces.push_back(static_cast<std::uint32_t>(size));
        mesh_.corners.insert(mesh_.corners.end(), indices_.begin(), indices_.end());
        for (std::size_t i = 0; has_texcoords_ && i < size; ++i) {
            auto& [values, corners] = mesh_.uvs[0];
            const bool given = texcoords_.size() == 2 * size;
            corners.push_back(given ? static_cast<std::uint32_t>(values.size()) : none);
            if (given) values.emplace_back(texcoords_[2 * i], texcoords_[2 * i + 1]);
        }
    } else {
        ++short_faces_;
    }
    indices_.clear();
    texcoords_.clear();
}

/// A color in 0..1, whatever its type in the file.
float PlyReader::color(Role role) {
    const Type type = vertex_->find(role)->type;
    const double scale = !is_integer(type) ? 1.0 : type == Type::u16 ? 65535.0 : 255.0;
    return finite_or_zero(row_[static_cast<std::size_t>(role)] / scale);
}

float PlyReader::finite_or_zero(double value) {
    if (const auto single = static_cast<float>(value); std::isfinite(single)) return single;
    ++not_finite_;
    return 0.0f;
}

}  // namespace

Mesh read_ply(const std::filesystem::path& file, std::string_view bytes, Budget& budget, const Share& share) {
    const Header header = read_header(file, bytes);
    Mesh mesh = PlyReader(header, budget, share.part(0, all_parsed, bytes.size())).read();
    auto source = std::make_shared<PlySource>();
    source->bytes = bytes;
    source->read = mesh;
    mesh.source = std::move(source);
    return mesh;
}

}  // namespace goffer::mesh
