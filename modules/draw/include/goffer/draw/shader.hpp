// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/draw/mesh.hpp>
#include <goffer/gpu/vertices.hpp>

#include <cstdint>
#include <string>

/// Shaders and programs of OpenGL, in the context that is current. They are given by OpenGL's names of them.

namespace goffer::draw {

/// Returns a shader of `stage` (GL_VERTEX_SHADER and the like), which is the caller's to delete. `text`
/// begins with the line that tells the version. Throws Error, with the driver's words in one line, where it
/// does not compile.
[[nodiscard]] std::uint32_t compile_shader(std::uint32_t stage, const std::string& text);

/// Links what is attached to `program`. Throws Error, as compile_shader() does, where it does not link.
void link_program(std::uint32_t program);

/// Has the vertex array that is bound read a body's records from the buffer that is bound: `column` at
/// location 0, then `wrinkle`, `normal`, `shape`, `tangent` and `joint`. Leaves out what the layout lacks.
void read_vertices(const gpu::VertexLayout& layout);

}  // namespace goffer::draw
