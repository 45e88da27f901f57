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

/// The attributes of a body's vertices, as a vertex shader of GLSL 3.30 or ES 3.00 declares them: `column` at
/// location 0, then `wrinkle`, `normal`, `shape`, `tangent` and `joint`.
inline constexpr const char* vertex_inputs = R"(
layout(location = 0) in vec4 column;
layout(location = 1) in vec4 wrinkle;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec4 shape;
layout(location = 4) in vec4 tangent;
layout(location = 5) in vec4 joint;
)";

/// Has the vertex array that is bound read them from the buffer that is bound, which holds a body's records.
/// Leaves out what the layout lacks.
void read_vertices(const gpu::VertexLayout& layout);

}  // namespace goffer::draw
