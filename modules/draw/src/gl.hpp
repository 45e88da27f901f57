// SPDX-License-Identifier: MIT
#pragma once

#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <epoxy/gl.h>
#endif

#include <bit>
#include <cstddef>
#include <utility>

/// OpenGL's functions, and its names that go when they go out of scope.

namespace goffer::draw {

/// Whether the context is one of OpenGL, not of ES or WebGL; and its version, 33 for 3.3.
#ifdef __EMSCRIPTEN__
inline bool is_desktop() {
    return false;
}
inline int version() {
    return 30;
}
inline void let_shaders_size_points() {}  // they may
#else
inline bool is_desktop() {
    return epoxy_is_desktop_gl();
}
inline int version() {
    return epoxy_gl_version();
}
inline void let_shaders_size_points() {
    if (is_desktop()) glEnable(GL_PROGRAM_POINT_SIZE);
}
#endif

template <auto Delete>
class Name {
public:
    Name() = default;
    explicit Name(GLuint name) : name_(name) {}
    Name(Name&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Name() {
        if (name_ != 0) Delete(name_);
    }
    operator GLuint() const { return name_; }
    /// Returns the name, which is the caller's from then on.
    [[nodiscard]] GLuint release() { return std::exchange(name_, 0); }

private:
    GLuint name_ = 0;
};

// OpenGL's own are pointers that are set when the program runs: they cannot be arguments of a template.
inline void delete_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
inline void delete_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
inline void delete_texture(GLuint name) {
    glDeleteTextures(1, &name);
}
inline void delete_query(GLuint name) {
    glDeleteQueries(1, &name);
}
inline void delete_shader(GLuint name) {
    glDeleteShader(name);
}
inline void delete_program(GLuint name) {
    glDeleteProgram(name);
}

using Buffer = Name<delete_buffer>;
using VertexArray = Name<delete_vertex_array>;
using TextureName = Name<delete_texture>;
using Query = Name<delete_query>;
using Shader = Name<delete_shader>;
using ProgramName = Name<delete_program>;

/// A new one, of the function that makes some.
template <class Named, class Make>
[[nodiscard]] Named made(Make make) {
    GLuint name = 0;
    make(1, &name);
    return Named(name);
}

/// A place in a buffer, as OpenGL's functions take it.
[[nodiscard]] inline const void* at_byte(std::size_t offset) {
    return std::bit_cast<const void*>(offset);
}

/// Has the vertex array that is bound read an attribute from the buffer that is bound; both in bytes.
inline void read_attribute(GLuint location, GLint floats, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, floats, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                          at_byte(offset));
}

}  // namespace goffer::draw
