// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include "budget.hpp"
#include "format.hpp"
#include "ply.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace goffer::mesh {
namespace {

using namespace ply;

/// Whether the header's types can hold what is added: interpolated coordinates, larger indices.
bool has_room(const Header& header, std::size_t vertices) {
    const auto coordinates = [](const Property& p) { return p.role > Role::nz || !is_integer(p.type); };
    const auto scalar = [](const Property& p) { return !p.count; };
    const auto& of_vertex = header.find("vertex")->properties;
    const Type index = header.find("face")->find(Role::indices)->type;
    const bool narrow = index < Type::i32;
    return std::ranges::all_of(of_vertex, coordinates) && std::ranges::all_of(of_vertex, scalar) &&
           (!narrow || vertices <= (index == Type::u16   ? 65536u
                                    : index == Type::i16 ? 32768u
                                                         : 128u));
}

/// Elements with as many rows as there are faces: texture coordinates of some scanners.
std::vector<const Element*> beside_faces(const Header& header) {
    const Element *vertex = header.find("vertex"), *face = header.find("face");
    std::vector<const Element*> found;
    for (const Element& element : header.elements) {
        if (&element != vertex && &element != face && element.count == face->count) found.push_back(&element);
    }
    return found;
}

void append_number(std::string& out, const Header& header, Type type, double number) {
    if (header.text) {
        out += out.empty() || out.back() == '\n' ? "" : " ";
        if (is_integer(type)) {
            out += std::to_string(std::llround(number));
        } else {
            type == Type::f64 ? append(out, number) : append(out, static_cast<float>(number));
        }
        return;
    }
    const auto put = [&]<class T>(T) {
        const double rounded = is_integer(type) ? std::round(number) : number;
        append_bytes(out, header.order, static_cast<T>(rounded));
    };
    switch (type) {
        case Type::i8:
            return put(std::int8_t{});
        case Type::u8:
            return put(std::uint8_t{});
        case Type::i16:
            return put(std::int16_t{});
        case Type::u16:
            return put(std::uint16_t{});
        case Type::i32:
            return put(std::int32_t{});
        case Type::u32:
            return put(std::uint32_t{});
        case Type::f32:
            return put(float{});
        case Type::f64:
            return put(double{});
    }
}

/// Edits the file of a mesh: rows for the new vertices follow the others, and rows for the pieces take the
/// place of their faces. Elements with rows for each face, which would be those of other faces now, are left
/// out. All other rows stay as they are, to the byte.
class PlyRefiner {
public:
    PlyRefiner(const Header& header, const Cut& cut, const Mesh& refined, const Share& share)
        : header_(header),
          cut_(cut),
          now_(refined),
          vertex_(header.find("vertex")),
          face_(header.find("face")),
          left_out_(beside_faces(header)),
          share_(share.part(0, 1, refined.positions.size() + refined.faces.size())),
          row_begin_(header.bytes.data() + header.size) {
        find_pieces();
        walk(header, *this);
        const std::string_view left = header_.bytes;
        body_.append(row_begin_, left.data() + left.size());
    }
    std::string finish() { return new_header() + body_; }

    void face(std::size_t, std::size_t, std::size_t size) {
        first_piece_.push_back(whole);
        refined_corner_ += size;
        rows_.push_back(1);
    }
    void piece(std::size_t face, std::size_t) {
        if (first_piece_.size() <= face) {
            first_piece_.push_back(refined_corner_);
            rows_.push_back(0);
        }
        refined_corner_ += 3;
        ++rows_.back();
    }

    void value(const Cursor&, const Property& property, const Value& value) {
        row_.emplace_back(&property, value.number);
    }

    void end_row(const Cursor& cursor, const Element& element) {
        const char* const row_end = cursor.rest().data();
        bool kept = !is_left_out(&element);
        if (&element == face_) kept = !end_face();
        if (kept) body_.append(row_begin_, row_end);
        row_begin_ = row_end;
        if (&element == vertex_) end_vertex();
        row_.clear();
    }
    void end(const Cursor&) {}

private:
    static constexpr std::size_t whole = ~std::size_t{0};

    void find_pieces() {
        cut_.each_face(*this);
        for (const std::uint32_t rows : rows_) more_faces_ += rows - 1;
    }

    [[nodiscard]] double new_number(const Property& property, std::size_t p, std::size_t vertex) const {
        const auto axis = static_cast<int>(property.role) % 3;
        if (property.role <= Role::z) return static_cast<double>(now_.positions[vertex][axis]);
        if (property.role <= Role::nz && !now_.normals.empty())
            return static_cast<double>(now_.normals.values[vertex][axis]);
        const auto& [a, b, t] = cut_.pieces().vertices[vertex - vertex_->count];
        const std::size_t width = vertex_->properties.size();
        const double from = numbers_[a * width + p], to = numbers_[b * width + p];
        const bool smooth =
            !is_integer(property.type) || (property.role >= Role::red && property.role <= Role::alpha);
        return smooth ? from + t * (to - from) : t < 0.5 ? from : to;
    }

    void end_vertex() {
        for (const auto& [property, number] : row_) numbers_.push_back(number);
        if (++vertices_ < vertex_->count) return;
        end_line();
        for (std::size_t v = vertices_; v < now_.positions.size(); ++v) {
            for (std::size_t p = 0; p < vertex_->properties.size(); ++p) {
                const Property& property = vertex_->properties[p];
                numbers_.push_back(new_number(property, p, v));
                append_number(body_, header_, property.type, numbers_.back());
            }
            end_line();
            share_.at(v);
        }
    }

    /// Ends the last line, which may lack its end in the file.
    void end_line() {
        if (header_.text && !body_.empty() && body_.back() != '\n') body_ += '\n';
    }

    /// Returns whether pieces took the place of the row.
    bool end_face() {
        const Property* indices = face_->find(Role::indices);
        const auto size = std::ranges::count(row_, indices, &std::pair<const Property*, double>::first);
        if (size < 3) return false;  // the reader leaves these out
        const std::size_t face = face_number_++, first = first_piece_[face];
        if (first == whole) return false;
        share_.at(now_.positions.size() + first / 3);
        end_line();
        for (std::size_t piece = 0; piece < rows_[face]; ++piece) append_piece(first + 3 * piece);
        return true;
    }

    void append_piece(std::size_t corner) {
        for (const Property& property : face_->properties) {
            std::vector<double> numbers;
            if (property.role == Role::indices) {
                numbers.assign(now_.corners.begin() + static_cast<std::ptrdiff_t>(corner),
                               now_.corners.begin() + static_cast<std::ptrdiff_t>(corner) + 3);
            } else if (property.role == Role::texcoord) {
                numbers = texcoords(corner);
            } else {
                for (const auto& [owner, number] : row_)
                    if (owner == &property) numbers.push_back(number);
            }
            if (property.count)
                append_number(body_, header_, *property.count, static_cast<double>(numbers.size()));
            for (const double number : numbers) append_number(body_, header_, property.type, number);
        }
        end_line();
    }

    [[nodiscard]] std::vector<double> texcoords(std::size_t corner) const {
        std::vector<double> numbers;
        if (now_.uvs.empty()) return numbers;
        const auto& [values, corners] = now_.uvs[0];
        for (std::size_t c = corner; c < corner + 3; ++c) {
            if (corners[c] == none) return {};
            numbers.push_back(static_cast<double>(values[corners[c]].x));
            numbers.push_back(static_cast<double>(values[corners[c]].y));
        }
        return numbers;
    }

    [[nodiscard]] bool is_left_out(const Element* element) const {
        return std::ranges::find(left_out_, element) != left_out_.end();
    }

    /// The header with the new counts, without what is left out.
    [[nodiscard]] std::string new_header() const {
        Editor out(header_.bytes.substr(0, header_.size));
        std::string_view rest = header_.bytes.substr(0, header_.size);
        bool leaves_out = false;
        while (!rest.empty()) {
            const std::string_view before = rest;
            std::string_view line = next_line(rest);
            const std::string_view word = next_token(line);
            if (word != "element" && word != "property") continue;
            std::string_view name, count;
            if (word == "element") {
                name = next_token(line), count = next_token(line);
                leaves_out = is_left_out(header_.find(name));
            }
            if (leaves_out) out.replace(before.substr(0, before.size() - rest.size()), "");
            if (name == "vertex") out.replace(count, std::to_string(now_.positions.size()));
            if (name == "face") out.replace(count, std::to_string(face_->count + more_faces_));
        }
        return out.finish();
    }

    const Header& header_;
    const Cut& cut_;
    const Mesh& now_;
    const Element *vertex_, *face_;
    std::vector<const Element*> left_out_;
    Share share_;  ///< in vertices and faces of the refined mesh
    /// For each face, the first corner of its pieces in the refined mesh, or `whole`.
    std::vector<std::size_t> first_piece_;
    std::vector<std::uint32_t> rows_;  ///< how many rows each face becomes
    std::size_t refined_corner_ = 0, face_number_ = 0;
    std::uint64_t more_faces_ = 0;
    std::vector<std::pair<const Property*, double>> row_;  ///< values of the current row
    std::vector<double> numbers_;  ///< the properties of each vertex, one after another
    std::size_t vertices_ = 0;     ///< how many of these are the mesh's
    const char* row_begin_;
    std::string body_;
};

}  // namespace

std::optional<Mesh> refined_ply(const Cut& cut, const Mesh& alone, const Share& share) {
    const auto* source = dynamic_cast<const PlySource*>(cut.mesh().source.get());
    if (!source || !only_bent(cut.mesh(), source->read)) return std::nullopt;
    const std::string now = write_ply(cut.mesh());
    const Header header = read_header({}, now);
    if (!has_room(header, alone.positions.size())) return std::nullopt;
    Budget budget;
    const std::string bytes = PlyRefiner(header, cut, alone, share.part(0.1, 0.6)).finish();
    Mesh out = read_ply({}, bytes, budget, share.part(0.6, 1));
    out.warnings = cut.mesh().warnings;
    for (const Element* element : beside_faces(header))
        out.warnings.push_back("element " + std::string(element->name) +
                               " is left out: it has as many rows as there are faces, and these are others "
                               "now; do not refine the mesh to keep it");
    return out;
}

}  // namespace goffer::mesh
