// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// Shaders and programs of OpenGL, in the context that is current. Names are OpenGL's.

namespace goffer::draw {

/// Returns a shader of `stage` (GL_VERTEX_SHADER and the like), which is the caller's to delete. `text`
/// begins with the line that tells the version. Throws Error, with the driver's words in one line, where it
/// does not compile.
[[nodiscard]] std::uint32_t compile_shader(std::uint32_t stage, const std::string& text);

/// Links what is attached to `program`. Throws Error, as compile_shader() does, where it does not link.
void link_program(std::uint32_t program);

}  // namespace goffer::draw
