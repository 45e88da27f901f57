// SPDX-License-Identifier: MIT
#include "mesh_data.hpp"
#include "program.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/vertices.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace goffer::draw {
namespace {

Buffer buffer_of(GLenum target, std::span<const std::byte> bytes) {
    Buffer buffer = made<Buffer>(glGenBuffers);
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return buffer;
}

/// Gives a buffer that is bound new contents, without waiting for what still reads the old ones. If they are
/// large, OpenGL is asked whether they got there, which waits for the device: browsers refuse them by errors
/// that say nothing.
void replace(GLenum target, std::span<const std::byte> bytes) {
    constexpr std::size_t large = std::size_t{1} << 28;
    const auto size = static_cast<GLsizeiptr>(bytes.size());
    glBufferData(target, size, nullptr, GL_STREAM_DRAW);
    glBufferSubData(target, 0, size, bytes.data());
    if (bytes.size() < large) return;
    GLint64 held = 0;
    glGetBufferParameteri64v(target, GL_BUFFER_SIZE, &held);
    if (glGetError() != GL_NO_ERROR || held != size)
        throw Error("the crowd's vertices are more than a buffer of this device holds; use fewer instances");
}

GLint parameter_of(Wrap wrap) {
    return wrap == Wrap::clamp ? GL_CLAMP_TO_EDGE : wrap == Wrap::mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

/// Every `step`-th pixel of every `step`-th row.
std::vector<std::uint8_t> thinned(const Texture& texture, int step) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y < texture.height; y += step) {
        for (int x = 0; x < texture.width; x += step) {
            const auto pixel = texture.rgba.subspan(
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                     static_cast<std::size_t>(x)),
                4);
            out.insert(out.end(), pixel.begin(), pixel.end());
        }
    }
    return out;
}

TextureName uploaded(const Texture& texture) {
    TextureName name = made<TextureName>(glGenTextures);
    glBindTexture(GL_TEXTURE_2D, name);
    GLint most = 1;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    const int step = (std::max(texture.width, texture.height) + most - 1) / most;
    const std::vector<std::uint8_t> less = step > 1 ? thinned(texture, step) : std::vector<std::uint8_t>();
    const std::uint8_t* const pixels = step > 1 ? less.data() : texture.rgba.data();
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, (texture.width + step - 1) / step,
                 (texture.height + step - 1) / step, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, parameter_of(texture.wrap_u));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, parameter_of(texture.wrap_v));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture.nearest ? GL_NEAREST : GL_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
    return name;
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
    read_if_any(joint, 4, layout, layout.joint);
}

/// Records once more, behind all others.
void append_copies(std::vector<std::byte>& records, std::span<const std::uint32_t> copies,
                   std::size_t stride) {
    std::size_t end = records.size();
    records.resize(end + copies.size() * stride);
    for (const std::uint32_t vertex : copies) {
        std::copy_n(records.begin() + static_cast<std::ptrdiff_t>(vertex * stride), stride,
                    records.begin() + static_cast<std::ptrdiff_t>(end));
        end += stride;
    }
}

}  // namespace

// A body's vertices are those of the mesh as it is bent and saved, which a seam does not split: another body
// would be fitted and deformed otherwise. So seams are split here, where it is drawn: what deforms still
// fills a body's vertices, and the copies of those on seams are made from them, by the upload for streams and
// once for the columns that the shader reads.
void Mesh::Data::set_skin(std::span<const std::uint32_t> of_body, const Skin& skin) {
    for (const Texture& texture : skin.textures) textures.push_back(uploaded(texture));
    if (skin.uvs.empty()) {
        glBindVertexArray(shader_array);
        triangle_indices = buffer_of(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(of_body));
        return;
    }
    std::vector<glm::vec2> placed(vertex_count);
    std::vector<bool> taken(vertex_count, false);
    using Bits = std::array<std::uint32_t, 2>;
    std::map<std::pair<std::uint32_t, Bits>, std::uint32_t> known;
    std::vector<std::uint32_t> drawn(of_body.begin(), of_body.end());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const glm::vec2 place(skin.uvs[i].x, 1 - skin.uvs[i].y);  // OpenGL's first row is the image's top
        const std::uint32_t vertex = of_body[i];
        const auto bits = std::bit_cast<Bits>(place);
        if (!taken[vertex]) {
            taken[vertex] = true;
            placed[vertex] = place;
        }
        if (std::bit_cast<Bits>(placed[vertex]) == bits) continue;
        const auto next = static_cast<std::uint32_t>(placed.size());
        const auto [copy, is_new] = known.try_emplace({vertex, bits}, next);
        if (is_new) {
            placed.push_back(place);
            copies.push_back(vertex);
        }
        drawn[i] = copy->second;
    }
    for (const GLuint array : {GLuint{streams_array}, GLuint{shader_array}}) {
        glBindVertexArray(array);
        if (uvs == 0) uvs = buffer_of(GL_ARRAY_BUFFER, std::as_bytes(std::span(placed)));
        read_attribute(uv, 2, sizeof(glm::vec2), 0);
    }
    triangle_indices = buffer_of(GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(drawn)));
}

Mesh::Mesh(const bend::Body& body, std::span<const std::uint32_t> triangles, std::span<const Part> parts,
           const Skin& skin)
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
    data.set_skin(triangles, skin);
    std::vector<std::byte> columns(data.vertex_count * layout.stride);
    gpu::write_vertices(body, columns);
    append_copies(columns, data.copies, layout.stride);
    glBindVertexArray(data.shader_array);
    data.columns = buffer_of(GL_ARRAY_BUFFER, columns);
    read_columns(layout);
}

Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::~Mesh() = default;

void Mesh::set_vertices(std::span<const Vertex> vertices) {
    const std::size_t count = data_->vertex_count;
    data_->instances = vertices.size() / count;
    data_->from = Data::From::vertices;
    glBindBuffer(GL_ARRAY_BUFFER, data_->vertices);
    if (data_->copies.empty()) {
        replace(GL_ARRAY_BUFFER, std::as_bytes(vertices));
        return;
    }
    std::vector<Vertex> drawn;
    drawn.reserve(data_->instances * data_->drawn_count());
    for (; vertices.size() >= count; vertices = vertices.subspan(count)) {
        drawn.insert(drawn.end(), vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count));
        for (const std::uint32_t vertex : data_->copies) drawn.push_back(vertices[vertex]);
    }
    replace(GL_ARRAY_BUFFER, std::as_bytes(std::span(drawn)));
}

void Mesh::set_coefficients(std::span<const bend::Coefficients> coefficients) {
    const std::size_t rows = coefficients.size() * bend::coefficient_rows;
    const auto whole = static_cast<GLsizei>(rows / texture_width);
    const auto rest = static_cast<GLsizei>(rows % texture_width);
    const auto* const texels = reinterpret_cast<const float*>(coefficients.data());
    if (data_->coefficients == 0) {
        data_->coefficients = made<TextureName>(glGenTextures);
        glBindTexture(GL_TEXTURE_2D, data_->coefficients);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glBindTexture(GL_TEXTURE_2D, data_->coefficients);
    const GLsizei lines = whole + (rest > 0 ? 1 : 0);
    if (data_->texture_lines < lines) {
        GLint most = 0;
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
        if (lines > most)
            throw Error("the instances' coefficients are more than a texture of this device holds");
        data_->texture_lines = lines;
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
    if (!data_->colored) return;
    std::vector<glm::vec3> drawn(colors.begin(), colors.end());
    for (const std::uint32_t vertex : data_->copies) drawn.push_back(colors[vertex]);
    replace(GL_ARRAY_BUFFER, std::as_bytes(std::span(drawn)));
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
    const std::size_t first = index * drawn_count() * sizeof(Vertex);
    glBindBuffer(GL_ARRAY_BUFFER, vertices);
    read_attribute(position, 3, sizeof(Vertex), first + offsetof(Vertex, position));
    read_attribute(normal, 3, sizeof(Vertex), first + offsetof(Vertex, normal));
}

}  // namespace goffer::draw
