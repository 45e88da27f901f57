// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

/// Pictures of meshes, rendered on the CPU, without a display or a GPU (Embree).

namespace goffer::view {

/// A picture that cannot be made. what() is one line: what is wrong, where, how to mend it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// One mesh of the scene. The caller owns the memory for the time of the call.
struct Model {
    std::span<const glm::vec3> positions;      ///< world space
    std::span<const std::uint32_t> triangles;  ///< 3 per triangle, each < positions.size()
    std::span<const glm::vec3> normals = {};   ///< empty (flat shading), or one per vertex
    std::span<const glm::vec4> colors = {};    ///< empty, or linear RGBA per vertex, times `color`
    glm::vec4 color{0.72f, 0.33f, 0.20f, 1};   ///< linear RGBA; alpha < 1: a ghost, see render()
};

/// Where the camera looks from. It is framed on all models' bounds.
struct Camera {
    glm::vec3 toward{-0.4f, -1.0f, -0.35f};  ///< viewing direction, world space, any length
    glm::vec3 up{0, 0, 1};                   ///< up in the picture, world space; not parallel to `toward`
    float field_of_view = 0.5f;              ///< vertical, rad
};

struct Settings {
    int width = 1280;
    int height = 960;
    int samples = 16;  ///< per pixel; more is smoother and slower
};

/// 8-bit sRGB, rows from top to bottom, 3 bytes a pixel.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Renders the models on a light ground-less background, lit by a key light from above the camera and by the
/// sky, with soft shadows, so that wrinkles are readable. Both sides of a surface look the same. A ghost is
/// translucent, casts no shadow, shows its front alone, and fades where it is close in front of a solid, so
/// that it hides nothing. Deterministic: the same input gives the same bytes on the same machine, whatever
/// the threads. Runs in the caller's oneTBB arena. Throws Error where nothing can be seen (no triangles,
/// sizes below 1) or a model is broken (an index out of range, a vertex that is not finite, an attribute of
/// another length), named by its place in `models`.
[[nodiscard]] Picture render(std::span<const Model> models, const Camera& camera,
                             const Settings& settings = {});

/// Writes a PNG, beside and renamed: on failure an existing file is left as it was. Throws Error where the
/// picture is empty or its bytes are not width x height x 3, and io::Error where the file cannot be written.
void save_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace goffer::view
