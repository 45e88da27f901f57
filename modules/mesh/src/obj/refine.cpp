// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include "budget.hpp"
#include "format.hpp"
#include "obj.hpp"

#include <goffer/io/text.hpp>

#include <algorithm>
#include <utility>

namespace goffer::mesh {
namespace {

/// How many faces each face of a mesh becomes; 0 where it stays what it is.
class FaceCounts {
public:
    explicit FaceCounts(const Cut& cut) : pieces(cut.mesh().faces.size(), 0) { cut.each_face(*this); }
    void face(std::size_t, std::size_t, std::size_t) {}
    void piece(std::size_t face, std::size_t) { ++pieces[face]; }

    std::vector<std::uint32_t> pieces;
};

/// Edits the text of a mesh: new values follow the last one of each kind, and pieces take the place of their
/// faces. All other lines stay as they are, but for references that count backward over new values.
class ObjRefiner {
public:
    ObjRefiner(std::string_view text, const Cut& cut, const Mesh& refined, const Share& share)
        : was_(cut.mesh()),
          now_(refined),
          share_(share.part(0, 1, refined.corners.size())),
          faces_(cut),
          out_(text) {
        Statement statement;
        for (std::string_view rest = io::without_bom(text); next_statement(rest, statement);)
            total_.add(statement);
        for (std::string_view rest = io::without_bom(text); next_statement(rest, statement);) take(statement);
    }
    std::string finish() { return out_.finish(); }

private:
    void take(const Statement& statement) {
        if (statement.keyword == "f") take_face(statement);
        if (statement.keyword == "l" || statement.keyword == "p") count_forwards(statement);
        const Counts before = seen_;
        seen_.add(statement);
        if (seen_.v != before.v && seen_.v == total_.v) add_vertices(statement);
        if (seen_.vt != before.vt && seen_.vt == total_.vt && !now_.uvs.empty()) add_uvs(statement);
        if (seen_.vn != before.vn && seen_.vn == total_.vn) add_normals(statement);
    }

    void begin_line(std::string& lines, const Statement& statement, const char* keyword) const {
        lines += statement.windows ? "\r\n" : "\n";
        lines += keyword;
    }

    void add_vertices(const Statement& statement) {
        std::string lines;
        const bool alpha =
            std::ranges::any_of(now_.colors, [](const glm::vec4& color) { return color.a != 1; });
        for (std::size_t i = was_.positions.size(); i < now_.positions.size(); ++i) {
            begin_line(lines, statement, "v");
            append_all(lines, now_.positions[i].x, now_.positions[i].y, now_.positions[i].z);
            if (now_.colors.empty()) continue;
            append_all(lines, now_.colors[i].r, now_.colors[i].g, now_.colors[i].b);
            if (alpha) append_all(lines, now_.colors[i].a);
        }
        out_.replace(statement.end, lines);
    }

    void add_uvs(const Statement& statement) {
        std::string lines;
        for (std::size_t i = was_.uvs[0].values.size(); i < now_.uvs[0].values.size(); ++i) {
            begin_line(lines, statement, "vt");
            append_all(lines, now_.uvs[0].values[i].x, now_.uvs[0].values[i].y);
        }
        out_.replace(statement.end, lines);
    }

    void add_normals(const Statement& statement) {
        std::string lines;
        for (std::size_t i = was_.normals.values.size(); i < now_.normals.values.size(); ++i) {
            begin_line(lines, statement, "vn");
            const glm::vec3& normal = now_.normals.values[i];
            append_all(lines, normal.x, normal.y, normal.z);
        }
        out_.replace(statement.end, lines);
    }

    void take_face(const Statement& statement) {
        std::size_t size = 0;
        for (std::string_view rest = statement.arguments; !next_argument(rest).empty();) ++size;
        const bool is_face = size >= 3;  // the reader leaves out what has fewer corners
        const std::size_t pieces = is_face ? faces_.pieces[face_++] : 0;
        if (pieces == 0) {
            count_forwards(statement);
            corner_ += is_face ? size : 0;
            return;
        }
        share_.at(corner_);
        std::string lines;
        for (std::size_t p = 0; p < pieces; ++p) {
            if (p > 0) begin_line(lines, statement, "f");
            for (const std::size_t end = corner_ + 3; corner_ < end; ++corner_)
                append_corner(lines, now_, corner_);
        }
        out_.replace(statement.arguments, lines);
    }

    void count_forwards(const Statement& statement) {
        std::string_view rest = statement.arguments;
        for (std::string_view token = next_argument(rest); !token.empty(); token = next_argument(rest)) {
            const auto parts = corner_parts(token);
            const std::array<std::pair<std::size_t, std::size_t>, 3> counts{
                {{seen_.v, total_.v}, {seen_.vt, total_.vt}, {seen_.vn, total_.vn}}};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [seen, total] = counts[k];
                const std::optional<std::int64_t> index = io::to_integer(parts[k]);
                if (index && *index < 0 && seen == total)
                    out_.replace(parts[k], std::to_string(from_zero(*index, seen) + 1));
            }
        }
    }

    const Mesh& was_;
    const Mesh& now_;
    Share share_;  ///< in corners of the refined mesh
    const FaceCounts faces_;
    Editor out_;
    Counts total_, seen_;
    std::size_t face_ = 0;    ///< of the mesh before refining
    std::size_t corner_ = 0;  ///< of the refined mesh
};

}  // namespace

std::optional<Mesh> refined_obj(const Cut& cut, const Mesh& alone, const Share& share) {
    const auto* source = dynamic_cast<const ObjSource*>(cut.mesh().source.get());
    if (!source || !only_bent(cut.mesh(), source->read)) return std::nullopt;
    const std::string text = write_obj(cut.mesh(), source->file);
    Budget budget;
    const std::string refined = ObjRefiner(text, cut, alone, share.part(0.2, 0.5)).finish();
    Mesh out = read_obj(source->file, refined, source->options, budget, share.part(0.5, 1));
    out.warnings = cut.mesh().warnings;
    return out;
}

}  // namespace goffer::mesh
