// SPDX-License-Identifier: MIT
#pragma once

#include "share.hpp"

#include <goffer/mesh/refined.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// What the parts of refined() share. Each format refines the file that a mesh came from and reads the
/// result, so that the mesh and its source go on belonging together.

namespace goffer::mesh {

/// A mesh and its pieces, known to fit together. Refers to both, which must outlive it.
class Cut {
public:
    /// Throws Error if they do not fit.
    Cut(const Mesh& mesh, const Subdivision& pieces, Share share = {});

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const Subdivision& pieces() const { return pieces_; }

    /// The first piece of a triangle; the last one is before that of the next triangle.
    [[nodiscard]] std::size_t first_piece(std::size_t triangle) const { return first_piece_[triangle]; }

    [[nodiscard]] bool is_cut(std::size_t triangle) const;

    /// The corner of the mesh that `vertex`, one of the mesh, has in the triangle that `piece` is of.
    [[nodiscard]] std::size_t corner(std::size_t piece, std::uint32_t vertex) const;

    /// Calls visit.face(face, corner, size) for each face that stays, where `corner` is its first one in the
    /// mesh, and visit.piece(face, piece) for each piece of the others, in the order of the refined mesh.
    template <class Visit>
    void each_face(Visit&& visit) const {
        std::size_t triangle = 0, corner = 0;
        for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
            const std::size_t size = mesh_.faces[face], end = triangle + size - 2;
            bool cut = false;
            for (std::size_t t = triangle; t < end; ++t) cut = cut || is_cut(t);
            if (!cut) visit.face(face, corner, size);
            for (std::size_t p = first_piece_[triangle]; cut && p < first_piece_[end]; ++p)
                visit.piece(face, p);
            triangle = end;
            corner += size;
        }
    }

private:
    /// The vertices of the mesh that a new one lies between, three at most; `none` stands for no more.
    using Roots = std::array<std::uint32_t, 3>;
    static constexpr std::uint32_t none = Attribute<glm::vec3>::none;

    void find_roots();
    [[nodiscard]] Roots roots(std::uint32_t vertex) const;
    void check_piece(std::size_t piece) const;

    const Mesh& mesh_;
    Subdivision pieces_;
    std::vector<Roots> roots_;              ///< of each new vertex
    std::vector<std::size_t> triangles_;    ///< the mesh's corners of each triangle, 3 each
    std::vector<std::size_t> first_piece_;  ///< of each triangle, and the number of pieces
};

/// Returns the refined mesh without a source, whatever the mesh came from: new vertices are behind all
/// others.
[[nodiscard]] Mesh refined_alone(const Cut& cut, Share share = {});

/// Return the refined mesh with a refined source; null if the mesh has no source of that format, differs from
/// it in more than what bending changes, or cannot be refined in it. `alone` is what refined_alone() returns.
[[nodiscard]] std::optional<Mesh> refined_obj(const Cut& cut, const Mesh& alone, const Share& share);
[[nodiscard]] std::optional<Mesh> refined_ply(const Cut& cut, const Mesh& alone, const Share& share);
[[nodiscard]] std::optional<Mesh> refined_stl(const Cut& cut, const Mesh& alone, const Share& share);
[[nodiscard]] std::optional<Mesh> refined_gltf(const Cut& cut, const Mesh& alone, const Share& share);

}  // namespace goffer::mesh
