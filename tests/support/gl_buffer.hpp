// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <stdexcept>
#include <string>

/// Buffers of OpenGL, in the context that is current. They live as long as it does.

namespace goffer::test {

inline void check(bool good, const std::string& what) {
    if (!good) throw std::runtime_error(what);
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
