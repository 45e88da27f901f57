// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <stdexcept>
#include <string>

/// Programs and buffers of OpenGL, in the context that is current. They live as long as it does.

namespace goffer::test {

inline void check(bool good, const std::string& what) {
    if (!good) throw std::runtime_error(what);
}

inline std::string log_of(GLuint shader, bool program) {
    char log[4096] = "";
    program ? glGetProgramInfoLog(shader, sizeof log, nullptr, log)
            : glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    return log;
}

/// Throws std::runtime_error, with the log, where it does not compile; as link_program() does.
inline GLuint compiled(GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    check(good != 0, log_of(shader, false));
    return shader;
}

inline void link_program(GLuint program) {
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    check(good != 0, log_of(program, true));
}

/// A buffer of so many bytes, bound to `target`; with `data` in it, if that is not null.
inline GLuint buffer(GLenum target, std::size_t bytes, const void* data) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(target, name);
    glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
    return name;
}

}  // namespace goffer::test
