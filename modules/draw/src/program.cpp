// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <goffer/draw/shader.hpp>
#include <goffer/gpu/source.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <string_view>

namespace goffer::draw {
namespace {

/// What both vertex shaders do with a vertex, however it was deformed. Instances differ a little in color.
constexpr std::string_view surface_outputs = R"(
layout(location = 2) in vec3 color;
layout(location = 7) in vec2 uv;
uniform mat4 view_projection;
uniform int first_instance, tinted;
out vec3 surface_position, surface_normal, surface_color;
out vec2 surface_uv;
void put(vec3 position, vec3 normal) {
    surface_uv = uv;
    surface_position = position;
    surface_normal = normal;
    float turn = 2.4 * float((first_instance + gl_InstanceID) % 1000);
    vec3 tint = vec3(sin(turn), sin(1.31 * turn + 1.0), sin(0.77 * turn + 2.0));
    surface_color = color * (tinted != 0 ? 1.0 + 0.12 * tint : vec3(1.0));
    gl_Position = view_projection * vec4(position, 1.0);
}
)";

constexpr std::string_view to_screen = R"(
vec3 encoded(vec3 light) {
    vec3 low = 12.92 * light, high = 1.055 * pow(max(light, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(light, vec3(0.0031308)));
}
)";

GLuint compiled(GLenum stage, const std::string& text) {
    const std::string version = is_desktop()
                                    ? "#version 330 core\n"
                                    : "#version 300 es\nprecision highp float;\nprecision highp sampler2D;\n";
    return compile_shader(stage, version + text);
}

}  // namespace

std::string streams_vertex() {
    return std::string(surface_outputs) + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
void main() { put(position, normal); }
)";
}

std::string coefficients_vertex() {
    return std::string(gpu::deform_glsl()) + std::string(surface_outputs) + R"(
layout(location = 1) in vec3 normal;
layout(location = 3) in vec4 column;
layout(location = 4) in vec4 wrinkle;
layout(location = 5) in vec4 shape;
layout(location = 6) in vec4 tangent;
layout(location = 8) in vec4 joint;
uniform sampler2D coefficients;
uniform int rows_per_instance;
vec4 goffer_row(int row) {
    int width = textureSize(coefficients, 0).x;
    return texelFetch(coefficients, ivec2(row % width, row / width), 0);
}
void main() {
    GofferVertex vertex = GofferVertex(column, wrinkle, normal, shape, tangent, joint);
    GofferBent bent = goffer_deform(vertex, gl_InstanceID * rows_per_instance);
    put(bent.position, bent.normal);
}
)";
}

// The light of view::render, without shadows: instead, less of the sky where a surface turns away.
std::string surface_fragment() {
    return std::string(to_screen) + R"(
uniform vec3 eye, right, up, forward, part_color;
uniform float opacity;
uniform sampler2D part_texture;
uniform int part_textured;
in vec3 surface_position, surface_normal, surface_color;
in vec2 surface_uv;
out vec4 pixel;
void main() {
    vec3 to_eye = normalize(eye - surface_position);
    vec3 face = cross(dFdx(surface_position), dFdy(surface_position));
    vec3 normal = normalize(surface_normal);
    if ((dot(face, to_eye) < 0.0) != (dot(face, normal) < 0.0)) normal = -normal;
    float cosine = dot(normal, to_eye);
    if (cosine < 0.01) {  // interpolation has turned it away
        normal = normalize(normal + (0.01 - cosine) * to_eye);
        cosine = 0.01;
    }
    vec3 key = normalize(-0.60 * right + 0.75 * up - 0.55 * forward);
    vec3 albedo = part_color * surface_color;
    vec3 texel = texture(part_texture, surface_uv).rgb;  // outside the branch: it needs the neighbors'
    if (part_textured != 0) albedo *= texel;
    vec3 sky = mix(vec3(0.16, 0.13, 0.12), vec3(0.34, 0.37, 0.42), 0.5 + 0.33 * dot(normal, up));
    sky *= 0.5 + 0.5 * cosine;
    float lit = max(0.0, dot(normal, key));
    vec3 light = albedo * (lit * vec3(0.94, 0.90, 0.83) + sky);
    light += 0.30 * max(0.0, 0.4 + 0.6 * dot(normal, key)) * albedo * albedo;
    light += 0.16 * pow(max(0.0, dot(normal, normalize(to_eye + key))), 22.0);
    float edge = 1.0 - cosine;
    light += 0.22 * edge * edge * edge * (0.6 + 0.4 * dot(normal, up)) * albedo;
    vec3 above = max(light - 0.75, vec3(0.0)) / 0.25;
    vec3 bent = min(light, vec3(0.75)) + 0.25 * (above / (1.0 + above));
    float brightest = max(max(light.r, light.g), max(light.b, 1e-6));
    light = 0.5 * (bent + light * (max(bent.r, max(bent.g, bent.b)) / brightest));
    pixel = vec4(encoded(light), opacity);
}
)";
}

std::string backdrop_vertex() {
    return R"(
out vec2 place;
void main() {
    place = vec2(float(gl_VertexID % 2) * 4.0 - 1.0, float(gl_VertexID / 2) * 4.0 - 1.0);
    gl_Position = vec4(place, 0.0, 1.0);
}
)";
}

std::string backdrop_fragment() {
    return std::string(to_screen) + R"(
in vec2 place;
out vec4 pixel;
void main() {
    vec2 away = place - vec2(0.0, 0.25);
    vec3 light = mix(vec3(0.915, 0.920, 0.925), vec3(0.70, 0.715, 0.735), min(1.0, 0.36 * dot(away, away)));
    pixel = vec4(encoded(light), 1.0);
}
)";
}

std::string mark_vertex() {
    return R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec3 color;
uniform mat4 view_projection;
uniform float pixels;
out vec3 mark_color;
void main() {
    mark_color = color;
    gl_Position = view_projection * vec4(position, 1.0);
    gl_PointSize = pixels;
}
)";
}

std::string mark_fragment() {
    return std::string(to_screen) + R"(
uniform float pixels;
in vec3 mark_color;
out vec4 pixel;
void main() {
    vec3 light = mark_color;
    if (pixels > 1.0) {  // a point, not a line
        float away = length(2.0 * gl_PointCoord - 1.0) * 0.5 * pixels;
        if (away > 0.5 * pixels) discard;
        if (away > 0.5 * pixels - 2.0) light = vec3(1.0);
    }
    pixel = vec4(encoded(light), 1.0);
}
)";
}

Program::Program(const std::string& vertex, const std::string& fragment) : name_(glCreateProgram()) {
    const Shader first(compiled(GL_VERTEX_SHADER, vertex)), second(compiled(GL_FRAGMENT_SHADER, fragment));
    glAttachShader(name_, first);
    glAttachShader(name_, second);
    link_program(name_);
    GLint uniforms = 0;
    glGetProgramiv(name_, GL_ACTIVE_UNIFORMS, &uniforms);
    for (GLuint i = 0; i < static_cast<GLuint>(uniforms); ++i) {
        char uniform[256] = "";
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(name_, i, sizeof uniform, nullptr, &size, &type, uniform);
        locations_.emplace(uniform, glGetUniformLocation(name_, uniform));
    }
}

/// -1, which OpenGL ignores, of what the program does not have.
GLint Program::location(const char* uniform) const {
    const auto found = locations_.find(std::string_view(uniform));
    return found == locations_.end() ? -1 : found->second;
}

void Program::set(const char* uniform, int value) const {
    glUniform1i(location(uniform), value);
}

void Program::set(const char* uniform, float value) const {
    glUniform1f(location(uniform), value);
}

void Program::set(const char* uniform, const glm::vec3& value) const {
    glUniform3fv(location(uniform), 1, glm::value_ptr(value));
}

void Program::set(const char* uniform, const glm::mat4& value) const {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace goffer::draw
