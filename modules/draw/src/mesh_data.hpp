// SPDX-License-Identifier: MIT
#pragma once

#include "gl.hpp"

#include <goffer/draw/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goffer::draw {

struct Mesh::Data {
    /// What instances were deformed by last.
    enum class From : std::uint8_t { nothing, vertices, coefficients };

    std::vector<Part> parts;
    std::vector<std::uint32_t> triangles;  // until their edges are asked for
    std::size_t vertex_count = 0, regions = 1;
    /// Vertices on seams once more, each for another of its texture coordinates: vertices of the body, whose
    /// copies are drawn as those behind its last one.
    std::vector<std::uint32_t> copies;
    std::vector<TextureName> textures;
    Buffer columns, vertices, colors, uvs, triangle_indices, edge_indices;
    TextureName coefficients;
    int texture_lines = 0;
    VertexArray streams_array, shader_array;
    GLsizei edge_ends = 0;
    bool colored = false;
    From from = From::nothing;
    std::size_t instances = 0;

    /// Makes the edges' indices, if they are not there yet.
    void make_edges();
    /// Vertices that are drawn of an instance.
    [[nodiscard]] std::size_t drawn_count() const { return vertex_count + copies.size(); }
    /// Fills `copies`, and buffers of texture coordinates and of the triangles that use them.
    void set_skin(std::span<const std::uint32_t> of_body, const Skin& skin);
    /// Has the streams' array read instance `index`.
    void point_at_instance(std::size_t index) const;
};

}  // namespace goffer::draw
