// SPDX-License-Identifier: MIT
#pragma once

#include "model.hpp"
#include "textures.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/mesh/mesh.hpp>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

/// How models look, and where they are looked at from, in pictures, in the window and in the page.

namespace goffer::cli {

/// Where a bent model is looked at from. At 0, 0 the eye looks across the plane that it bends in, or that
/// most of its bend is in, and it lies from left to right, its squeezed side up. Degrees.
struct Viewpoint {
    double azimuth = 0;     ///< turns the eye about the picture's vertical, toward the tip's side
    double elevation = 35;  ///< raises it, up to 90, where it looks at the squeezed side
};

/// Which way the eye looks, and what is up in the picture; model space.
struct Sight {
    glm::vec3 toward, up;
};

/// The sight from there of a body in these poses, one per region.
[[nodiscard]] Sight sight_of(const bend::Body& body, std::span<const bend::Pose> poses,
                             const Viewpoint& from);

/// The color of parts that have none of their own, of one model of several.
[[nodiscard]] glm::vec4 plain_color(std::size_t model);

/// The colors of vertices as pictures show them, linear RGBA, in place of materials' (a texture is multiplied
/// by them) and in the order of `rest`, the arrays of `mesh`. Parts without, whose vertices are white, have
/// their materials' color, or `plain`. Empty where the whole mesh is without.
[[nodiscard]] std::vector<glm::vec4> vertex_colors(const mesh::Mesh& mesh, const mesh::VertexArrays& rest,
                                                   const glm::vec4& plain);

/// A part of a mesh, and how it looks.
struct PartLook {
    mesh::TriangleRange triangles;
    glm::vec4 color;              ///< linear RGBA; a texture, or the vertices' colors, are multiplied by it
    std::size_t material = none;  ///< whose texture of `textures` it shows, or none

    static constexpr std::size_t none = ~std::size_t{0};
};

/// The parts of `mesh` that have triangles, in order, with their materials' colors or textures; those without
/// either are `plain`. `textures` are those of `mesh`, or none. `colored`: the vertices have colors.
[[nodiscard]] std::vector<PartLook> looks_of(const mesh::Mesh& mesh, const Textures& textures, bool colored,
                                             const glm::vec4& plain);

}  // namespace goffer::cli
