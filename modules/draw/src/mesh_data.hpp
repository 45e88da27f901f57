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
    Buffer columns, vertices, colors, triangle_indices, edge_indices;
    Texture coefficients;
    int texture_lines = 0;
    VertexArray streams_array, shader_array;
    GLsizei edge_ends = 0;
    bool colored = false;
    From from = From::nothing;
    std::size_t instances = 0;

    /// Makes the edges' indices, if they are not there yet.
    void make_edges();
    /// Has the streams' array read instance `index`.
    void point_at_instance(std::size_t index) const;
};

}  // namespace goffer::draw
