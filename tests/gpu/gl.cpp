// SPDX-License-Identifier: MIT
#include "gl.hpp"

#include "gl_vertex.hpp"

#include <goffer/bend/kernel_input.hpp>
#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/shader.hpp>
#include <goffer/gpu/source.hpp>

#include <epoxy/gl.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace goffer::test {
namespace {

constexpr std::size_t texture_width = 1024;

const std::string vertex_main = R"(
uniform int rows_per_instance;
out vec3 bent_position;
out vec3 bent_normal;
out vec4 bent_tangent;
void main() {
    GofferVertex vertex = GofferVertex(column, wrinkle, normal, shape, tangent, joint);
    GofferBent bent = goffer_deform(vertex, gl_InstanceID * rows_per_instance);
    bent_position = bent.position;
    bent_normal = bent.normal;
    bent_tangent = bent.tangent;
    gl_Position = vec4(bent.position, 1.0);
}
)";

const std::string core_rows = R"(
uniform samplerBuffer coefficients;
vec4 goffer_row(int row) { return texelFetch(coefficients, row); }
)";

const std::string embedded_rows = R"(
uniform highp sampler2D coefficients;
vec4 goffer_row(int row) { return texelFetch(coefficients, ivec2(row % 1024, row / 1024), 0); }
)";

const std::string compute_main = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Vertices { float vertices[]; };
layout(std430, binding = 1) readonly buffer Rows { vec4 rows[]; };
layout(std430, binding = 2) writeonly buffer Results { float results[]; };
uniform int rows_per_instance, vertex_count, instance_count, stride, shape, tangent, joint;
vec4 goffer_row(int row) { return rows[row]; }
vec4 four(int at) { return vec4(vertices[at], vertices[at + 1], vertices[at + 2], vertices[at + 3]); }
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= vertex_count * instance_count) return;
    int at = i % vertex_count * stride;
    GofferVertex vertex;
    vertex.column = four(at);
    vertex.wrinkle = four(at + 4);
    vertex.normal = vec3(vertices[at + 8], vertices[at + 9], vertices[at + 10]);
    vertex.shape = shape < 0 ? vec4(0.0, 0.0, 0.0, 1.0) : four(at + shape);
    vertex.tangent = tangent < 0 ? vec4(0.0, 0.0, 0.0, 1.0) : four(at + tangent);
    vertex.joint = joint < 0 ? vec4(0.0, 0.0, 0.0, 1.0) : four(at + joint);
    GofferBent bent = goffer_deform(vertex, i / vertex_count * rows_per_instance);
    for (int c = 0; c < 3; ++c) {
        results[10 * i + c] = bent.position[c];
        results[10 * i + 3 + c] = bent.normal[c];
    }
    for (int c = 0; c < 4; ++c) results[10 * i + 6 + c] = bent.tangent[c];
}
)";

std::string text_of(GlApi api) {
    const std::string deform(gpu::deform_glsl());
    switch (api) {
        case GlApi::core:
            return "#version 330 core\n" + deform + core_rows + draw::vertex_inputs + vertex_main;
        case GlApi::embedded:
            return "#version 300 es\n" + deform + embedded_rows + draw::vertex_inputs + vertex_main;
        case GlApi::compute:
            return "#version 430 core\n" + deform + compute_main;
    }
    return {};
}

GLuint linked(GlApi api) {
    if (api != GlApi::compute)
        return vertex_program(text_of(api), api == GlApi::embedded,
                              {"bent_position", "bent_normal", "bent_tangent"});
    const GLuint program = glCreateProgram();
    glAttachShader(program, draw::compile_shader(GL_COMPUTE_SHADER, text_of(api)));
    draw::link_program(program);
    return program;
}

/// Binds the coefficients as a texture buffer, or as a texture of whole lines.
void set_texture(GlApi api, std::span<const float> rows) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    if (api == GlApi::core) {
        const GLuint data = buffer(GL_TEXTURE_BUFFER, rows.size_bytes(), rows.data());
        glBindTexture(GL_TEXTURE_BUFFER, texture);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, data);
        return;
    }
    const std::size_t lines = (rows.size() / 4 + texture_width - 1) / texture_width;
    std::vector<float> padded(rows.begin(), rows.end());
    padded.resize(4 * texture_width * lines);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, texture_width, static_cast<GLsizei>(lines), 0, GL_RGBA,
                 GL_FLOAT, padded.data());
}

draw::OffscreenContext::Api context_for(GlApi api) {
    using Api = draw::OffscreenContext::Api;
    if (api == GlApi::embedded) return Api::es30;
    return api == GlApi::compute ? Api::core43 : Api::core33;
}

class Deformer : public GlDeformer {
public:
    Deformer(GlApi api, std::string& why) : context_(context_for(api), why), api_(api) {
        if (context_) program_ = linked(api);
    }

    std::vector<GlVertex> run(std::span<const std::byte> vertices, const gpu::VertexLayout& layout,
                              std::size_t count, std::span<const float> rows,
                              std::size_t instances) override {
        glUseProgram(program_);
        const auto set = [&](const char* name, std::size_t value) {
            glUniform1i(glGetUniformLocation(program_, name), static_cast<GLint>(value));
        };
        set("rows_per_instance", rows.size() / 4 / instances);
        std::vector<GlVertex> result(count * instances);
        const std::size_t bytes = result.size() * sizeof(GlVertex);
        GLenum target = GL_TRANSFORM_FEEDBACK_BUFFER;
        if (api_ == GlApi::compute) {
            target = GL_SHADER_STORAGE_BUFFER;
            set("vertex_count", count);
            set("instance_count", instances);
            set("stride", layout.stride / sizeof(float));
            const auto floats = [](std::size_t offset) {
                return offset == gpu::VertexLayout::none ? offset : offset / sizeof(float);
            };
            set("shape", floats(layout.shape));
            set("tangent", floats(layout.tangent));
            set("joint", floats(layout.joint));
            glBindBufferBase(target, 0, buffer(target, vertices.size(), vertices.data()));
            glBindBufferBase(target, 1, buffer(target, rows.size_bytes(), rows.data()));
            glBindBufferBase(target, 2, buffer(target, bytes, nullptr));
            glDispatchCompute(static_cast<GLuint>((result.size() + 63) / 64), 1, 1);
            glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        } else {
            GLuint array = 0;
            glGenVertexArrays(1, &array);
            glBindVertexArray(array);
            buffer(GL_ARRAY_BUFFER, vertices.size(), vertices.data());
            draw::read_vertices(layout);
            set_texture(api_, rows);
            capture(bytes, count, instances);
        }
        read_back(target, std::span(result));
        return result;
    }

    [[nodiscard]] std::string device() const override {
        const auto text = [](GLenum name) {
            return std::string(reinterpret_cast<const char*>(glGetString(name)));
        };
        return text(GL_VERSION) + ", " + text(GL_RENDERER);
    }

private:
    draw::OffscreenContext context_;
    GlApi api_;
    GLuint program_ = 0;
};

}  // namespace

std::unique_ptr<GlDeformer> GlDeformer::make(GlApi api, std::string& why) {
    why.clear();
    auto deformer = std::make_unique<Deformer>(api, why);
    if (!why.empty()) return nullptr;
    return deformer;
}

}  // namespace goffer::test
