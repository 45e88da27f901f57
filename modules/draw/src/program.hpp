// SPDX-License-Identifier: MIT
#pragma once

#include "gl.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <map>
#include <string>

namespace goffer::draw {

/// Where vertex attributes are, in all programs.
enum Attribute : GLuint {
    position = 0,
    normal = 1,
    color = 2,
    column = 3,
    wrinkle = 4,
    shape = 5,
    tangent = 6,
    uv = 7,
    joint = 8
};

/// The texture unit of surfaces' textures. That of coefficients is 0.
inline constexpr int surface_unit = 1;

/// Rows of a texture of coefficients are this long, in texels.
inline constexpr int texture_width = 1024;

/// Texts of shaders, without the line that tells the version.
[[nodiscard]] std::string streams_vertex();       ///< vertices that the processor has deformed
[[nodiscard]] std::string coefficients_vertex();  ///< vertices that the shader deforms
[[nodiscard]] std::string surface_fragment();
[[nodiscard]] std::string backdrop_vertex();
[[nodiscard]] std::string backdrop_fragment();
[[nodiscard]] std::string mark_vertex();
[[nodiscard]] std::string mark_fragment();

/// A program, linked.
class Program {
public:
    /// Throws Error with what the compiler says.
    Program(const std::string& vertex, const std::string& fragment);

    void use() const { glUseProgram(name_); }
    /// Set a uniform of the program, which is in use; one that it does not have is left alone.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, const glm::vec3& value) const;
    void set(const char* uniform, const glm::mat4& value) const;

private:
    [[nodiscard]] GLint location(const char* uniform) const;

    ProgramName name_;
    std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace goffer::draw
