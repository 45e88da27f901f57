// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/gpu/vertices.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// OpenGL without a display, by EGL: what runs goffer's shaders in tests.

namespace goffer::test {

/// Which OpenGL, and which stage deforms.
enum class GlApi : std::uint8_t {
    core,      ///< 3.3 core: a vertex shader, coefficients in a texture buffer
    embedded,  ///< ES 3.0: a vertex shader, coefficients in a texture
    compute,   ///< 4.3 core: a compute shader, everything in storage buffers
};

/// A vertex that a shader has deformed.
struct GlVertex {
    float position[3], normal[3], tangent[4];
};

/// A context with a program that deforms. At most one at a time.
class GlDeformer {
public:
    /// Null, and *why says so, where there is no such OpenGL. Throws std::runtime_error where something does
    /// not compile.
    static std::unique_ptr<GlDeformer> make(GlApi api, std::string& why);
    virtual ~GlDeformer() = default;

    /// Deforms `instances` instances of `count` vertices, one behind the other. `rows` are as many for each
    /// instance. Throws std::runtime_error where OpenGL reports an error.
    [[nodiscard]] virtual std::vector<GlVertex> run(std::span<const std::byte> vertices,
                                                    const gpu::VertexLayout& layout, std::size_t count,
                                                    std::span<const float> rows, std::size_t instances) = 0;

    /// What it runs on.
    [[nodiscard]] virtual std::string device() const = 0;
};

}  // namespace goffer::test
