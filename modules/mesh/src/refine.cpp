// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include "budget.hpp"
#include "face_cutter.hpp"
#include "interpolate.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

namespace goffer::mesh {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw Error("refined: " + what + "; give what was made for this mesh");
}

/// A value that stands between two others of an attribute.
struct Mix {
    std::uint32_t a, b;
    std::uint64_t t;
    bool operator==(const Mix&) const = default;
};

struct MixHash {
    std::size_t operator()(const Mix& mix) const {
        std::uint64_t h = ((std::uint64_t{mix.a} << 32) | mix.b) * 0x9e3779b97f4a7c15u;
        h = (h ^ (h >> 29) ^ mix.t) * 0xbf58476d1ce4e5b9u;
        return h ^ (h >> 32);
    }
};

/// Makes the faces, corners and parts of the refined mesh.
class FaceMaker {
public:
    FaceMaker(const Cut& cut, Mesh& out) : cut_(cut), out_(out), count_(cut.mesh().faces.size(), 0) {
        out_.corners.clear();
        out_.faces.clear();
        cut.each_face(*this);
        for (Part& part : out_.parts) {
            const auto first = count_.begin() + part.first_face, end = first + part.face_count;
            part.first_face = next_face_;
            part.face_count = 0;
            for (auto c = first; c != end; ++c) part.face_count += *c;
            next_face_ += part.face_count;
        }
    }

    void face(std::size_t face, std::size_t corner, std::size_t size) {
        const auto first = cut_.mesh().corners.begin() + static_cast<std::ptrdiff_t>(corner);
        out_.corners.insert(out_.corners.end(), first, first + static_cast<std::ptrdiff_t>(size));
        out_.faces.push_back(static_cast<std::uint32_t>(size));
        count_[face] = 1;
    }

    void piece(std::size_t face, std::size_t piece) {
        const auto corners = cut_.pieces().triangles.subspan(3 * piece, 3);
        out_.corners.insert(out_.corners.end(), corners.begin(), corners.end());
        out_.faces.push_back(3);
        ++count_[face];
    }

private:
    const Cut& cut_;
    Mesh& out_;
    std::vector<std::uint32_t> count_;  ///< how many faces each face becomes
    std::uint32_t next_face_ = 0;
};

/// Refines an attribute with an index per corner. Where both ends of an edge have a value there is a new one,
/// which corners with the same two values share.
template <class T, class Interpolate>
class CornerMaker {
public:
    CornerMaker(const Cut& cut, const Attribute<T>& attribute, Interpolate between)
        : cut_(cut), was_(attribute), out_{attribute.values, {}}, between_(between) {
        cut.each_face(*this);
    }
    Attribute<T> finish() && { return std::move(out_); }

    void face(std::size_t, std::size_t corner, std::size_t size) {
        const auto first = was_.corners.begin() + static_cast<std::ptrdiff_t>(corner);
        out_.corners.insert(out_.corners.end(), first, first + static_cast<std::ptrdiff_t>(size));
    }

    void piece(std::size_t, std::size_t piece) {
        const std::uint32_t parent = cut_.pieces().parents[piece];
        if (parent != parent_) known_.clear();
        parent_ = parent;
        for (const std::uint32_t vertex : cut_.pieces().triangles.subspan(3 * piece, 3))
            out_.corners.push_back(value(piece, vertex));
    }

private:
    /// The value that a vertex has in the triangle of a piece. New ones may lie between others, to any depth.
    std::uint32_t value(std::size_t piece, std::uint32_t wanted) {
        const auto old = static_cast<std::uint32_t>(cut_.mesh().positions.size());
        open_.assign(1, wanted);
        while (!open_.empty()) {
            const std::uint32_t vertex = open_.back();
            if (vertex < old) {
                known_.try_emplace(vertex, was_.corners[cut_.corner(piece, vertex)]);
            } else if (!known_.contains(vertex)) {
                const EdgeVertex& edge = cut_.pieces().vertices[vertex - old];
                const auto a = known_.find(edge.a), b = known_.find(edge.b);
                if (a == known_.end()) open_.push_back(edge.a);
                if (b == known_.end()) open_.push_back(edge.b);
                if (a == known_.end() || b == known_.end()) continue;
                known_.emplace(vertex, mixed({a->second, b->second, std::bit_cast<std::uint64_t>(edge.t)}));
            }
            open_.pop_back();
        }
        return known_.at(wanted);
    }

    std::uint32_t mixed(const Mix& mix) {
        if (mix.a == mix.b) return mix.a;
        if (mix.a == was_.none || mix.b == was_.none) return was_.none;
        const auto next = static_cast<std::uint32_t>(out_.values.size());
        const auto [entry, is_new] = made_.try_emplace(mix, next);
        if (is_new)
            out_.values.push_back(
                between_(out_.values[mix.a], out_.values[mix.b], std::bit_cast<double>(mix.t)));
        return entry->second;
    }

    const Cut& cut_;
    const Attribute<T>& was_;
    Attribute<T> out_;
    Interpolate between_;
    std::unordered_map<Mix, std::uint32_t, MixHash> made_;
    std::uint32_t parent_ = 0;
    std::unordered_map<std::uint32_t, std::uint32_t> known_;  ///< values of vertices in the triangle parent_
    std::vector<std::uint32_t> open_;                         ///< vertices whose value is to be found
};

template <class T, class F>
void append_cuts(std::vector<T>& values, const Cut& cut, F between) {
    if (values.empty()) return;
    values.reserve(values.size() + cut.pieces().vertices.size());
    for (const auto& [a, b, t] : cut.pieces().vertices) values.push_back(between(values[a], values[b], t));
}

template <class T, class F>
void refine(Attribute<T>& attribute, const Cut& cut, F between) {
    if (attribute.per_vertex()) {
        append_cuts(attribute.values, cut, between);
    } else {
        attribute = CornerMaker(cut, attribute, between).finish();
    }
}

/// What a refined mesh takes, and its source as much again.
void check_limits(const Mesh& mesh, const Subdivision& pieces, const Limits& limits) {
    std::uint64_t vertex = sizeof(glm::vec3), corner = sizeof(std::uint32_t);
    const auto add = [&](const auto& attribute) {
        if (attribute.empty()) return;
        vertex += sizeof(attribute.values[0]);
        if (!attribute.per_vertex()) corner += sizeof(std::uint32_t);
    };
    add(mesh.normals);
    add(mesh.tangents);
    for (const auto& uvs : mesh.uvs) add(uvs);
    if (!mesh.colors.empty()) vertex += sizeof(glm::vec4);
    Budget budget(limits);
    budget.take_vertices(mesh.positions.size() + pieces.vertices.size(), 2 * vertex);
    budget.take_faces(pieces.triangles.size() / 3, pieces.triangles.size(), 2 * corner);
}

}  // namespace

Cut::Cut(const Mesh& mesh, const Subdivision& pieces, Share share) : mesh_(mesh), pieces_(pieces) {
    FaceCutter cut(mesh);
    std::size_t first = 0;
    triangles_.reserve(3 * triangle_count(mesh));
    for (const std::uint32_t size : mesh.faces) {
        const auto own = cut(first, size);
        triangles_.insert(triangles_.end(), own.begin(), own.end());
        first += size;
    }
    find_roots();
    share = share.part(0.2, 1, pieces.parents.size());
    const std::size_t triangles = triangles_.size() / 3;
    if (pieces.triangles.size() != 3 * pieces.parents.size())
        refuse(std::to_string(pieces.triangles.size()) + " corners for " +
               std::to_string(pieces.parents.size()) + " triangles");
    for (std::size_t p = 0; p < pieces.parents.size(); ++p) {
        const std::size_t parent = pieces.parents[p];
        if (parent >= triangles || parent + 1 < first_piece_.size() || parent > first_piece_.size())
            refuse("piece " + std::to_string(p) + " is of triangle " + std::to_string(parent) +
                   ", which is out of range or out of order");
        if (parent == first_piece_.size()) first_piece_.push_back(p);
        check_piece(p);
        share.at(p);
    }
    if (first_piece_.size() != triangles)
        refuse("there are pieces for " + std::to_string(first_piece_.size()) + " of " +
               std::to_string(triangles) + " triangles");
    first_piece_.push_back(pieces.parents.size());
}

Cut::Roots Cut::roots(std::uint32_t vertex) const {
    const std::size_t count = mesh_.positions.size();
    return vertex < count ? Roots{vertex, none, none} : roots_[vertex - count];
}

void Cut::find_roots() {
    const std::size_t count = mesh_.positions.size();
    if (count + pieces_.vertices.size() > none) refuse("there are more vertices than 32 bits can number");
    roots_.reserve(pieces_.vertices.size());
    for (const auto& [a, b, t] : pieces_.vertices) {
        const auto refuse_it = [&](const char* why) {
            refuse("new vertex " + std::to_string(roots_.size()) + " does not lie " + why);
        };
        const std::size_t made = count + roots_.size();
        if (a >= made || b >= made || a == b || !(t > 0 && t < 1))
            refuse_it("between two of the mesh or before it");
        Roots own = roots(a);
        for (const std::uint32_t root : roots(b)) {
            if (root == none || std::ranges::find(own, root) != own.end()) continue;
            const auto place = std::ranges::find(own, none);
            if (place == own.end()) refuse_it("in a triangle");
            *place = root;
        }
        roots_.push_back(own);
    }
}

void Cut::check_piece(std::size_t piece) const {
    const std::size_t* parent = &triangles_[3 * std::size_t{pieces_.parents[piece]}];
    const auto in_parent = [&](std::uint32_t root) {
        return root == none ||
               std::any_of(parent, parent + 3, [&](std::size_t c) { return mesh_.corners[c] == root; });
    };
    for (const std::uint32_t vertex : pieces_.triangles.subspan(3 * piece, 3)) {
        if (vertex >= mesh_.positions.size() + roots_.size() ||
            !std::ranges::all_of(roots(vertex), in_parent))
            refuse("piece " + std::to_string(piece) + ": vertex " + std::to_string(vertex) +
                   " does not lie in triangle " + std::to_string(pieces_.parents[piece]));
    }
}

bool Cut::is_cut(std::size_t triangle) const {
    const std::size_t first = first_piece_[triangle];
    const auto corners = pieces_.triangles.subspan(3 * first, 3);
    return first_piece_[triangle + 1] - first > 1 ||
           std::ranges::any_of(corners, [&](auto v) { return v >= mesh_.positions.size(); });
}

std::size_t Cut::corner(std::size_t piece, std::uint32_t vertex) const {
    const std::size_t* parent = &triangles_[3 * std::size_t{pieces_.parents[piece]}];
    return *std::find_if(parent, parent + 3, [&](std::size_t c) { return mesh_.corners[c] == vertex; });
}

Mesh refined_alone(const Cut& cut, Share share) {
    Mesh out = cut.mesh();
    out.source = nullptr;
    share = share.part(0, 1, 4);
    const FaceMaker faces(cut, out);
    share.at(1);
    append_cuts(out.positions, cut, linear<3>);
    append_cuts(out.colors, cut, linear<4>);
    share.at(2);
    refine(out.normals, cut, direction);
    refine(out.tangents, cut, tangent_between);
    share.at(3);
    for (auto& uvs : out.uvs) refine(uvs, cut, linear<2>);
    return out;
}

namespace {

constexpr double checked = 0.15;  ///< the share of the time by when all pieces are looked at

Mesh refined_with_source(const Cut& cut, const Share& share) {
    Mesh alone = refined_alone(cut, share.part(0, 0.2));
    for (const auto with_source : {refined_gltf, refined_obj, refined_ply, refined_stl})
        if (std::optional<Mesh> out = with_source(cut, alone, share.part(0.2, 1))) return std::move(*out);
    return alone;
}

}  // namespace

Mesh refined(const Mesh& mesh, const Subdivision& pieces, const Limits& limits,
             const std::function<void(double)>& progress) {
    Listener listener(progress);
    const Share all(listener);
    check_limits(mesh, pieces, limits);
    const Cut cut(mesh, pieces, all.part(0, checked));
    Mesh out = pieces.vertices.empty() ? mesh : refined_with_source(cut, all.part(checked, 1));
    listener.hear(1);
    return out;
}

}  // namespace goffer::mesh
