// SPDX-License-Identifier: MIT
#include "gl.hpp"

#include <goffer/draw/mesh.hpp>
#include <goffer/draw/shader.hpp>

#include <algorithm>

namespace goffer::draw {
namespace {

[[noreturn]] void refuse(const std::string& what, std::string log) {
    std::ranges::replace(log, '\n', ' ');
    throw Error("OpenGL's driver refuses " + what + ": " + log);
}

}  // namespace

std::uint32_t compile_shader(std::uint32_t stage, const std::string& text) {
    Shader shader(glCreateShader(stage));
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good != 0) return shader.release();
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    refuse("a shader", log);
}

void link_program(std::uint32_t program) {
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good != 0) return;
    char log[2048] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    refuse("a program", log);
}

void read_vertices(const gpu::VertexLayout& layout) {
    GLuint location = 0;
    const auto read = [&](GLint floats, std::size_t offset) {
        if (offset != gpu::VertexLayout::none) read_attribute(location, floats, layout.stride, offset);
        ++location;
    };
    read(4, layout.column);
    read(4, layout.wrinkle);
    read(3, layout.normal);
    read(4, layout.shape);
    read(4, layout.tangent);
    read(4, layout.joint);
}

}  // namespace goffer::draw
