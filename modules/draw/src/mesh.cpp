// SPDX-License-Identifier: MIT
#include "mesh_data.hpp"
#include "program.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/vertices.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace goffer::draw {
namespace {

Buffer buffer_of(GLenum target, std::span<const std::byte> bytes) {
    Buffer buffer = made<Buffer>(glGenBuffers);
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return buffer;
}

/// New contents for a buffer that is bound, without waiting for who still reads the old ones.
void replace(GLenum target, std::span<const std::byte> bytes) {
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), nullptr, GL_STREAM_DRAW);
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void read_if_any(GLuint location, GLint floats, const gpu::VertexLayout& layout, std::size_t offset) {
    if (offset != gpu::VertexLayout::none) read_attribute(location, floats, layout.stride, offset);
}

void read_columns(const gpu::VertexLayout& layout) {
    read_attribute(column, 4, layout.stride, layout.column);
    read_attribute(wrinkle, 4, layout.stride, layout.wrinkle);
    read_attribute(normal, 3, layout.stride, layout.normal);
    read_if_any(shape, 4, layout, layout.shape);
    read_if_any(tangent, 4, layout, layout.tangent);
}

}  // namespace

Mesh::Mesh(const bend::Body& body, std::span<const std::uint32_t> triangles, std::span<const Part> parts)
    : data_(std::make_unique<Data>()) {
    Data& data = *data_;
    data.parts.assign(parts.begin(), parts.end());
    data.triangles.assign(triangles.begin(), triangles.end());
    data.vertex_count = body.vertex_count();
    data.regions = body.region_count();
    data.vertices = made<Buffer>(glGenBuffers);
    data.colors = made<Buffer>(glGenBuffers);
    data.streams_array = made<VertexArray>(glGenVertexArrays);
    data.shader_array = made<VertexArray>(glGenVertexArrays);
    const gpu::VertexLayout layout = gpu::vertex_layout(body);
    std::vector<std::byte> columns(data.vertex_count * layout.stride);
    gpu::write_vertices(body, columns);
    glBindVertexArray(data.shader_array);
    data.columns = buffer_of(GL_ARRAY_BUFFER, columns);
    read_columns(layout);
    data.triangle_indices = buffer_of(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(triangles));
}

Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::~Mesh() = default;

void Mesh::set_vertices(std::span<const Vertex> vertices) {
    data_->instances = vertices.size() / data_->vertex_count;
    data_->from = Data::From::vertices;
    glBindBuffer(GL_ARRAY_BUFFER, data_->vertices);
    replace(GL_ARRAY_BUFFER, std::as_bytes(vertices));
}

void Mesh::set_coefficients(std::span<const bend::Coefficients> coefficients) {
    const std::size_t rows = coefficients.size() * bend::coefficient_rows;
    const auto whole = static_cast<GLsizei>(rows / texture_width);
    const auto rest = static_cast<GLsizei>(rows % texture_width);
    const auto* const texels = reinterpret_cast<const float*>(coefficients.data());
    if (data_->coefficients == 0) {
        data_->coefficients = made<Texture>(glGenTextures);
        glBindTexture(GL_TEXTURE_2D, data_->coefficients);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glBindTexture(GL_TEXTURE_2D, data_->coefficients);
    if (data_->texture_lines < whole + 1) {
        GLint most = 0;
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
        if (whole + 1 > most)
            throw Error("the instances' coefficients are more than a texture of this device holds");
        data_->texture_lines = whole + 1;
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, texture_width, data_->texture_lines, 0, GL_RGBA, GL_FLOAT,
                     nullptr);
    }
    if (whole > 0) glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texture_width, whole, GL_RGBA, GL_FLOAT, texels);
    if (rest > 0) {
        const std::size_t done = std::size_t{4} * texture_width * static_cast<std::size_t>(whole);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, whole, rest, 1, GL_RGBA, GL_FLOAT, texels + done);
    }
    data_->instances = coefficients.size() / data_->regions;
    data_->from = Data::From::coefficients;
}

void Mesh::set_colors(std::span<const glm::vec3> colors) {
    data_->colored = !colors.empty();
    for (const GLuint array : {GLuint{data_->streams_array}, GLuint{data_->shader_array}}) {
        glBindVertexArray(array);
        glBindBuffer(GL_ARRAY_BUFFER, data_->colors);
        if (data_->colored) {
            read_attribute(color, 3, sizeof(glm::vec3), 0);
        } else {
            glDisableVertexAttribArray(color);
        }
    }
    if (data_->colored) replace(GL_ARRAY_BUFFER, std::as_bytes(colors));
}

void Mesh::Data::make_edges() {
    if (edge_ends > 0) return;
    std::vector<std::array<std::uint32_t, 2>> edges;
    edges.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t one = triangles[i], other = triangles[i % 3 == 2 ? i - 2 : i + 1];
        edges.push_back({std::min(one, other), std::max(one, other)});
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    edge_ends = static_cast<GLsizei>(2 * edges.size());
    glBindVertexArray(streams_array);  // without one a core profile takes no indices
    edge_indices = buffer_of(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(edges)));
    triangles = {};
}

void Mesh::Data::point_at_instance(std::size_t index) const {
    const std::size_t first = index * vertex_count * sizeof(Vertex);
    glBindBuffer(GL_ARRAY_BUFFER, vertices);
    read_attribute(position, 3, sizeof(Vertex), first + offsetof(Vertex, position));
    read_attribute(normal, 3, sizeof(Vertex), first + offsetof(Vertex, normal));
}

}  // namespace goffer::draw
