// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace goffer::mesh {

/// Cuts the faces of a mesh into triangles as mesh::triangles() promises: convex ones into fans, concave ones
/// by clipping ears (Meisters 1975). This is own code because Debian has no package of earcut.hpp, and CGAL
/// would bring far more than it does. Memory is kept from face to face, so that cutting a mesh allocates
/// little. Not thread-safe; make one for each thread.
class FaceCutter {
public:
    /// Faces of more corners are fans, concave or not: the time to clip ears grows with the square.
    static constexpr std::size_t max_corners = 4096;

    /// `mesh` must fit together as a loaded one does, and outlive the cutter.
    explicit FaceCutter(const Mesh& mesh) : mesh_(mesh) {}

    /// Returns the triangles of the face that has `size` corners from corner `first` of the mesh on: 3
    /// corners of the mesh each, size - 2 triangles, wound as the face is. Valid until the next call.
    [[nodiscard]] std::span<const std::size_t> operator()(std::size_t first, std::size_t size);

private:
    using Corner = std::uint32_t;  ///< of the face, counted from 0

    /// The corners that are left, as a ring.
    struct Ring {
        std::vector<Corner> before, after;
        std::size_t left = 0;
    };

    /// The corners that are left and not convex, in no order, and where each corner is among them.
    struct Reflex {
        std::vector<Corner> corners;
        std::vector<std::size_t> place;
        static constexpr std::size_t none = ~std::size_t{0};
    };

    bool lay_flat(std::size_t first, std::size_t size);
    [[nodiscard]] double twice_area(Corner a, Corner b, Corner c) const;
    [[nodiscard]] double rounding(Corner a, Corner b, Corner c) const;
    [[nodiscard]] bool concave() const;
    [[nodiscard]] bool holds(Corner a, Corner b, Corner c, Corner point, bool strictly) const;
    [[nodiscard]] bool is_ear(Corner corner, bool lenient) const;
    void note_turn(Corner corner, bool convex);
    void find_ears(Corner start, bool lenient);
    void clip(Corner corner, bool lenient);
    bool clip_ears();
    void fan(std::size_t size);
    [[nodiscard]] double covered() const;
    [[nodiscard]] std::span<const std::size_t> placed(std::size_t first);

    const Mesh& mesh_;
    std::vector<glm::dvec2> points_;  ///< of the face, in the plane, counterclockwise
    double reach_ = 0;                ///< largest coordinate of the face, by which its positions are rounded
    Ring ring_;
    Reflex reflex_;
    std::vector<bool> ears_;
    std::vector<Corner> triangles_, clipped_;
    std::vector<std::size_t> corners_;
};

}  // namespace goffer::mesh
