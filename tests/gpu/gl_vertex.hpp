// SPDX-License-Identifier: MIT
#pragma once

#include "support/gl_buffer.hpp"

#include <goffer/draw/offscreen.hpp>
#include <goffer/draw/shader.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

/// Vertex shaders whose outputs are read back, by transform feedback.

namespace goffer::test {

/// A program of one vertex shader, of OpenGL ES or not, whose `outputs` are captured one behind the other.
inline GLuint vertex_program(const std::string& text, bool embedded,
                             std::initializer_list<const char*> outputs) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, draw::compile_shader(GL_VERTEX_SHADER, text));
    if (embedded)  // which has no program without one
        glAttachShader(program,
                       draw::compile_shader(GL_FRAGMENT_SHADER, "#version 300 es\nvoid main() {}\n"));
    glTransformFeedbackVaryings(program, static_cast<GLsizei>(outputs.size()), outputs.begin(),
                                GL_INTERLEAVED_ATTRIBS);
    draw::link_program(program);
    return program;
}

/// Runs the program that is current over the vertices that are bound, into a buffer of so many bytes, which
/// stays bound to GL_TRANSFORM_FEEDBACK_BUFFER.
inline void capture(std::size_t bytes, std::size_t count, std::size_t instances) {
    // Without something to draw into nothing is drawn: there is no window.
    const draw::OffscreenTarget target_pixel(1, 1);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr));
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(count), static_cast<GLsizei>(instances));
    glEndTransformFeedback();
}

/// Copies what is in the buffer that is bound to `target`.
template <class T>
void read_back(GLenum target, std::span<T> result) {
    const void* const mapped =
        glMapBufferRange(target, 0, static_cast<GLsizeiptr>(result.size_bytes()), GL_MAP_READ_BIT);
    check(mapped != nullptr, "the results cannot be mapped");
    std::copy_n(static_cast<const T*>(mapped), result.size(), result.begin());
    glUnmapBuffer(target);
    check(glGetError() == GL_NO_ERROR, "OpenGL reports an error");
}

}  // namespace goffer::test
