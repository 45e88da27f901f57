// SPDX-License-Identifier: MIT
#include "mesh_data.hpp"
#include "program.hpp"
#include "stopwatch.hpp"

#include <goffer/bend/kernel_input.hpp>
#include <goffer/draw/renderer.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace goffer::draw {
namespace {

void check_context() {
    const int found = version(), least = is_desktop() ? 33 : 30;
    if (found < least)
        throw Error("OpenGL 3.3 or ES 3.0 is needed, and this is " + std::to_string(found / 10) + "." +
                    std::to_string(found % 10) + "; try a newer driver, or Mesa's in software");
}

/// To its own unit; what is bound to unit 0, which stays the active one, is left alone.
void bind_surface_texture(GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + surface_unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace

struct Renderer::Data {
    Program streams{streams_vertex(), surface_fragment()};
    Program coefficients{coefficients_vertex(), surface_fragment()};
    Program backdrop{backdrop_vertex(), backdrop_fragment()};
    Program marks{mark_vertex(), mark_fragment()};
    VertexArray empty_array = made<VertexArray>(glGenVertexArrays);
    VertexArray marks_array = made<VertexArray>(glGenVertexArrays);
    Buffer marks_buffer = made<Buffer>(glGenBuffers);
    Stopwatch stopwatch;
    glm::mat4 view_projection{1};

    Data();
    /// Draws the triangles or, over them, the edges of the instances that the array in use reads.
    static void draw_instances(const Program& program, const Mesh::Data& mesh, const Look& look,
                               std::size_t first, std::size_t count, bool edges);
    void draw_pass(const Mesh::Data& mesh, const Look& look, bool edges) const;
    void draw_marks(GLenum kind, std::span<const Mark> corners, float pixels) const;
};

Renderer::Data::Data() {
    glBindVertexArray(marks_array);
    glBindBuffer(GL_ARRAY_BUFFER, marks_buffer);
    read_attribute(position, 3, sizeof(Mark), offsetof(Mark, position));
    read_attribute(color, 3, sizeof(Mark), offsetof(Mark, color));
}

Renderer::Renderer() {
    check_context();
    data_ = std::make_unique<Data>();
}

Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::begin(const OrbitCamera& camera, const Viewport& viewport) {
    data_->stopwatch.start();
    data_->view_projection = camera.view_projection(viewport.aspect());
    for (const Program* program : {&data_->streams, &data_->coefficients}) {
        program->use();
        program->set("view_projection", data_->view_projection);
        program->set("eye", camera.eye());
        program->set("right", camera.right());
        program->set("up", camera.up());
        program->set("forward", camera.forward());
        program->set("part_texture", surface_unit);
    }
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    glEnable(GL_SCISSOR_TEST);
    glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    glBindVertexArray(data_->empty_array);
    data_->backdrop.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    let_shaders_size_points();
}

void Renderer::Data::draw_instances(const Program& program, const Mesh::Data& mesh, const Look& look,
                                    std::size_t first, std::size_t count, bool edges) {
    program.set("first_instance", static_cast<int>(look.first_instance + first));
    const auto instances = static_cast<GLsizei>(count);
    if (edges) {
        program.set("part_textured", 0);
        glDrawElementsInstanced(GL_LINES, mesh.edge_ends, GL_UNSIGNED_INT, nullptr, instances);
        return;
    }
    for (const Part& part : mesh.parts) {
        const bool textured = look.textured && part.texture != Part::none;
        program.set("part_textured", textured ? 1 : 0);
        if (textured) bind_surface_texture(mesh.textures[part.texture]);
        program.set("part_color", mesh.colored && !textured ? glm::vec3(1) : part.color);
        glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * part.count), GL_UNSIGNED_INT,
                                at_byte(sizeof(std::uint32_t) * 3 * part.first), instances);
    }
}

void Renderer::Data::draw_pass(const Mesh::Data& mesh, const Look& look, bool edges) const {
    const bool by_shader = mesh.from == Mesh::Data::From::coefficients;
    const Program& program = by_shader ? coefficients : streams;
    program.use();
    program.set("tinted", look.tinted ? 1 : 0);
    program.set("opacity", edges ? 0.35f : look.opacity);
    glBindVertexArray(by_shader ? mesh.shader_array : mesh.streams_array);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, edges ? mesh.edge_indices : mesh.triangle_indices);
    // What an array that is switched off reads.
    glVertexAttrib3f(color, 1, 1, 1);
    if (edges) program.set("part_color", glm::vec3(0));
    if (by_shader) {
        program.set("rows_per_instance", static_cast<int>(mesh.regions * bend::coefficient_rows));
        glBindTexture(GL_TEXTURE_2D, mesh.coefficients);
        draw_instances(program, mesh, look, 0, mesh.instances, edges);
        return;
    }
    for (std::size_t i = 0; i < mesh.instances; ++i) {
        mesh.point_at_instance(i);
        draw_instances(program, mesh, look, i, 1, edges);
    }
}

void Renderer::draw(Mesh& mesh, const Look& look) {
    Mesh::Data& drawn = *mesh.data_;
    if (drawn.from == Mesh::Data::From::nothing || drawn.instances == 0) return;
    const bool blended = look.opacity < 1;
    if (blended || look.wireframe) glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (blended) {
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
    }
    if (look.wireframe) {
        drawn.make_edges();
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
    }
    data_->draw_pass(drawn, look, false);
    glDisable(GL_POLYGON_OFFSET_FILL);
    if (look.wireframe) {
        glEnable(GL_BLEND);
        data_->draw_pass(drawn, look, true);
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

void Renderer::Data::draw_marks(GLenum kind, std::span<const Mark> corners, float pixels) const {
    marks.use();
    marks.set("view_projection", view_projection);
    marks.set("pixels", pixels);
    glBindVertexArray(marks_array);
    glBindBuffer(GL_ARRAY_BUFFER, marks_buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(kind, 0, static_cast<GLsizei>(corners.size()));
}

void Renderer::draw_lines(std::span<const Mark> corners) {
    if (!corners.empty()) data_->draw_marks(GL_LINES, corners, 1);
}

void Renderer::draw_points(std::span<const Mark> points, float pixels) {
    if (points.empty()) return;
    glDisable(GL_DEPTH_TEST);
    data_->draw_marks(GL_POINTS, points, pixels);
    glEnable(GL_DEPTH_TEST);
}

void Renderer::end() {
    data_->stopwatch.stop();
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw Error("OpenGL reports error " + std::to_string(error) +
                    (error == GL_OUT_OF_MEMORY ? ": it has no memory left; use fewer instances" : ""));
}

std::optional<double> Renderer::draw_milliseconds() const {
    return data_->stopwatch.milliseconds();
}

std::string Renderer::device() const {
    const auto text = [](GLenum name) {
        return std::string(reinterpret_cast<const char*>(glGetString(name)));
    };
    return text(GL_VERSION) + ", " + text(GL_RENDERER);
}

}  // namespace goffer::draw
